"""Makes the bundled models, and writes them as GLB files into ``src/uwsim/data/models``.

``python -m scripts.models`` writes all files, ``python -m scripts.models objects/rocks`` one of
them. The same sources give the same bytes. The wheel has the files and not this package.
"""
