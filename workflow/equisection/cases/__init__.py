"""What decides a result, and nothing else, as a small canonical file with a hash."""
