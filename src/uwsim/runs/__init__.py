"""Planning and executing runs: from benchmark, scene and algorithm to the files of a result."""
