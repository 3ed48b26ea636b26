"""The steps of a linkage's plans in words: marks, vectors, guides, compound motion, the lever; the conclusions."""
