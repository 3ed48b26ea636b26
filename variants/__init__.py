"""Tasks as data: their reader, their variants, and what is solved and drawn of them."""
