"""From runs to decisions: what is best, and what fits measurements, with as few runs as it takes."""
