"""Expansion of xacro and XInclude when a scene or robot file is read.

.. code-block:: xml

    <UWSimScene xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:include filename="$(find uwsim)/data/scenes/deviceLibrary.xml.xacro"/>
      <xacro:property name="depth" value="3.5"/>
      <xacro:macro name="buoy" params="name x y:=0">
        <object> <name>${name}</name> <file>objects/buoy.obj</file>
          <position> <x>${x}</x> <y>${y}</y> <z>${depth - 0.5}</z> </position>
          <orientation> <r>0</r> <p>${-pi/2}</p> <y>0</y> </orientation>
        </object>
      </xacro:macro>
      <xacro:buoy name="first" x="1"/>
    </UWSimScene>

Python's ``eval`` is not used, so that a file of another author runs no code.
"""

from __future__ import annotations

from .document import library_of, parse_expanded

__all__ = ["library_of", "parse_expanded"]
