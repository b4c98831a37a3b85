"""Data sets as NetCDF files: written whole or not at all, validated on reading."""

import os

# HDF5 locks a file while it is open, and gives up where the file system has no locks, as many of
# clusters have none. Results are written aside and renamed, so nobody reads what is being written
# and the lock guards nothing. Whoever sets the variable has the last word. It is read when the
# library is loaded, which is why it is set here.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
