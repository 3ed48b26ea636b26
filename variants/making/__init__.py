"""The variants of a task: all beside one another, questions about them, new ones."""
