"""What the engine costs on this machine: the parts of scripts/bench."""
