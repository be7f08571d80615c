"""Wrong scenes and profiles by the thousand, from a seed."""
