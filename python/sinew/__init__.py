"""Sinew: position based dynamics of soft bodies on Vulkan compute. Units are SI; y points up."""
from ._sinew import Blade, Device, Error, Field, Grab, HostCollider, Motion, Part, Scene, Settings, Simulation, State, World
from ._sinew import version as __version__
from .program import describe, run, study

__all__ = ["Blade", "Device", "Error", "Field", "Grab", "HostCollider", "Motion", "Part", "Scene", "Settings", "Simulation", "State", "World", "describe",
           "run", "study"]
