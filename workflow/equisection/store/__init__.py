"""Results by the hash of their case, the job that makes them, and the lock on a directory."""
