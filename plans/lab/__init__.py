"""The lab: races of methods in speed and accuracy, what drawings and models lose over a cycle or by a step."""
