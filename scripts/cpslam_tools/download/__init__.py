"""Fetching the public sequences: transfers that can be resumed, archives that stay inside their folder."""
