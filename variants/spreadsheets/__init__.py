"""Files of cells, CSV and XLSX: read as a grid within bounds, and their headers understood."""
