"""Linkages: links and pairs, structure, the driver, the Assur groups, force plans and Zhukovsky's lever."""
