"""Import of worlds and models of other simulators: a folder with a scene, robots and meshes.

.. code-block:: console

    $ uwsim import my_world.sdf -o my_scene

`import_file` reads SDF (``sdf/``), interprets its plug-ins (``plugins/``) and writes the files of
the scene (``output/``). The report states what became of each element, with its line and reason.
"""

from .import_file import Import, ImportRequest, import_file
from .report import ImportReport, ImportRow, Place

__all__ = ["Import", "ImportReport", "ImportRequest", "ImportRow", "Place", "import_file"]
