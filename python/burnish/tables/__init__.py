"""Committed data, each with the script that makes it."""
