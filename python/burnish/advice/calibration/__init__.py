"""The error model is calibrated here, and what is promised of it is judged."""
