"""Many recordings: one a task, done in this process, in several, or by the workers of a Dask cluster.

Each way is an `Engine`: it takes a task and paths, and gives the results as they come, each exactly once.
"""
