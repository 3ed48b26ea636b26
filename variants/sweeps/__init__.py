"""A task over its whole cycle: columns, tables, data, files."""
