"""Files of cells, CSV and XLSX: read as a grid within bounds, their headers understood, and written."""
