"""Which sampler and count meet an error, and at what price; and an error for every pixel."""
