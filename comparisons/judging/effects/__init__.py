"""The assumptions of the half-plane, and what dropping each may change."""
