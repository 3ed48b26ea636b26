"""Groups of class III: their construction, and how they are followed through the cycle."""
