"""The same drum in several codes: what is common to them, and how each is run."""
