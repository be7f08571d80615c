"""Wrong scenes, profiles and results by the thousand, from a seed."""
