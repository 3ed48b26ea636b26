"""The sheet: shapes in millimetres, text and its metrics, formats, title blocks, and one writer per file format."""
