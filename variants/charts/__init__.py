"""Charts of a task: speed against accuracy, stability, depth of the model."""
