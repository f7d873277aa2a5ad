"""Commands for campaigns: benchmarks that run in shards on many machines."""
