"""The study of a configuration: which cases there are, and what goes into one."""
