"""Charts: pictures of plain rows by matplotlib, which is loaded only when one is drawn."""
