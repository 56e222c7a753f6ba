"""Models of lobes, one file each, and what they share."""
