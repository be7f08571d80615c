"""The heat of friction: flash temperatures by both models, and the verdict on their difference."""
