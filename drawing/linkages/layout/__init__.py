"""How the figures of a linkage come to fit on pages: scale factors, formats, zones."""
