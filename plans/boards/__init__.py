"""Boards that numbers are made on: one position or many, in other precisions, with derivatives."""
