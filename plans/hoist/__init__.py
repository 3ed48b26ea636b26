"""The hoist rope: its forces, strength and validity, and the methods that find them."""
