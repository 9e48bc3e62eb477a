"""Types and documentation of the module. Arrays are float32 and uint32; units are SI; y points up."""
import os
from typing import Any, Literal, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
Vector = Sequence[float]

class Error(RuntimeError):
    """A failure of the library or of the program. `result` names it: "SINEW_ERROR_INVALID_SCENE"."""
    result: str

class Device:
    """A Vulkan device with a queue: by index or part of a name, else the best; `software` asks for lavapipe."""
    def __init__(self, device: Optional[str] = None, software: bool = False, validation: bool = False, pipeline_cache: bytes = b"") -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def is_software(self) -> bool: ...
    def pipeline_cache(self) -> bytes:
        """Pipelines made so far, for `pipeline_cache` of a later run."""

class Settings:
    """How a scene is solved. Each property is also a keyword of the constructor."""
    def __init__(self, **settings: Any) -> None: ...
    solver: str  # "split", "jacobi", "gauss_seidel"
    substeps: int  # a step; 0 = chosen by stiffness and tolerance
    iterations: int
    tolerance: float
    contact_margin: float
    contact_room: int
    grabs: int  # at a time, at most 8
    fields: int  # at a time, at most 16
    host_colliders: int  # at a time, at most 1024
    motions: int  # in a step, at most 64
    frames_in_flight: int
    omega: float
    theta: float
    levels: Union[int, Literal["auto"]]  # coarse levels of bodies on grids, at most 6; "auto" = as many as win at equal error
    weight: float
    over_relaxation: float
    warm_start: float
    sleeps: bool
    keeps_forces: bool
    keeps_previous: bool  # for previous_positions and previous_skin_vertices
    sharp_clamp: bool  # of split: links are clamped by the directions in which they meet (docs/clamp.md)
    events: Sequence[str]  # kinds that events() lists: contact_begins, contact_ends, cut, tear, pieces, sleeps, wakes, lacks_room, fragments
    event_room: int  # events kept of a step, at most 65536

class Scene:
    """Bodies, constraints and colliders. Empty, or read from a scene file or a mesh file."""
    def __init__(self, path: Optional[str] = None) -> None: ...
    dt: float  # [s]
    gravity: Sequence[float]  # [m/s^2]
    @property
    def particle_count(self) -> int: ...
    @property
    def settings(self) -> Settings:
        """Settings of the file."""
    def add_particles(self, positions: ArrayLike, velocities: Optional[ArrayLike] = None, inverse_masses: ArrayLike = 1.0,
                      radii: ArrayLike = 0.0) -> int:
        """Particles at positions (n, 3) [m]; inverse masses [1/kg], 0 = never moves; radii of contacts [m]. Returns the first index."""
    def add_links(self, pairs: ArrayLike, rest_lengths: ArrayLike, compliances: ArrayLike = 0.0) -> None:
        """Distance constraints of pairs (n, 2) of particles: rest lengths [m], compliances [m/N], 0 = rigid."""
    def add_fixed(self, particles: ArrayLike) -> None: ...
    def add_attachments(self, particles: ArrayLike, anchors: ArrayLike, compliances: ArrayLike = 0.0) -> int:
        """Springs to points (n, 3) that `step(anchors=...)` moves [m]. Returns the first index."""
    def add_body(self, name: str, first: int, count: int) -> int:
        """Names a range of particles. Returns the index of the body, as the functions below do."""
    def set_absent(self, body: int, absent: bool = True) -> None:
        """Lets a body start outside of the world: motions of kind spawn and despawn let it in and out."""
    def add_plane(self, normal: Vector = (0, 1, 0), offset: float = 0.0, friction: float = 0.0, restitution: float = 0.0) -> None: ...
    def add_cloth(self, **sheet: Any) -> int:
        """name, columns, rows, spacing, origin, right, down, area_density, membrane_stiffness, bending_stiffness, skip_stiffness,
        thickness, tethers, pinned, cuttable, tear_strain, toughness: as SinewCloth in sinew.h."""
    def add_lattice(self, **lattice: Any) -> int:
        """name, cells, origin, spacing, young_modulus, poisson_ratio, recovery, density, radius, cuttable, tear_strain, toughness, skin, faces,
        fill: as SinewLattice in sinew.h."""
    def add_mesh(self, vertices: ArrayLike, triangles: ArrayLike, texture_coordinates: Optional[ArrayLike] = None, **mesh: Any) -> int:
        """A voxel body of a triangle mesh: vertices (n, 3) [m], triangles (m, 3), texture_coordinates (n, 2); name, spacing, resolution, young_modulus,
        poisson_ratio, recovery, density, touches, cuttable, tear_strain, toughness: as SinewMesh in sinew.h."""
    def add_mesh_file(self, path: str, scale: float = 1.0, **mesh: Any) -> int: ...
    def validate(self, settings: Optional[Settings] = None) -> None:
        """Raises Error with a sentence a line."""
    def describe(self, settings: Optional[Settings] = None) -> str: ...

class Grab:
    """Pulls the particles near one particle towards a target, from its second step on."""
    def __init__(self, particle: int, target: Vector, radius: float = 0.0, stiffness: float = 400.0, damping: float = 40.0) -> None: ...

class HostCollider:
    """A collider that the host moves: its pose at the end of the step [m], rotation as x, y, z, w; sizes [m], max_speed [m/s]. As
    SinewHostCollider in sinew.h."""
    def __init__(self, shape: Literal["sphere", "capsule", "box"], position: Vector, rotation: Sequence[float] = (0, 0, 0, 1),
                 radius: float = 0.0, half_length: float = 0.0, half_extents: Vector = (0, 0, 0), friction: float = 0.3,
                 static_friction: float = 0.0, max_speed: float = 10.0) -> None: ...

class Field:
    """A force field: as SinewField in sinew.h."""
    def __init__(self, kind: Literal["uniform", "radial", "wind", "turbulence"], vector: Vector = (0, 0, 0), center: Vector = (0, 0, 0),
                 radius: float = 0.0, strength: float = 0.0, scale: float = 1.0, body: int = 0xFFFFFFFF) -> None: ...

class Motion:
    """A change of the motion of a body or region, once, at the start of the first step of step(): linear is a velocity [m/s], an impulse
    [N s] or a displacement [m] of the centre of mass, angular a velocity [rad/s] or moment [N m s] about it, rotation that of a pose or spawn
    (x, y, z, w). SinewMotion of sinew_motions.h has the rules."""
    def __init__(self, kind: Literal["add_velocity", "set_velocity", "impulse", "pose", "spawn", "despawn"], body: int = 0xFFFFFFFF, linear: Vector = (0, 0, 0),
                 angular: Vector = (0, 0, 0), rotation: Sequence[float] = (0, 0, 0, 1), center: Vector = (0, 0, 0),
                 radius: float = 0.0) -> None: ...

class Blade:
    """The edge of a blade before and after a step, (n, 3) points each [m], 2 to 256. It cuts what lies between, in bodies that may be
    cut. `carried` continues the stroke of the step before: the blade starts where it ended, wherever the material has moved."""
    def __init__(self, before: ArrayLike, after: ArrayLike, carried: bool = False) -> None: ...

class State:
    """A saved state of a simulation."""

class Simulation:
    """A scene that is stepped. Arrays are views of its memory if the host sees that, else copies; they cannot be written to. A view
    shows later steps too, and keeps the simulation alive; when a step has needed more room, ask for the array again."""
    def __init__(self, device: Device, scene: Scene, settings: Optional[Settings] = None) -> None:
        """Without settings, those of the scene's file."""
    def step(self, count: int = 1, dt: Optional[float] = None, gravity: Optional[Vector] = None, anchors: Optional[ArrayLike] = None,
             grabs: Sequence[Grab] = (), fields: Sequence[Field] = (), host_colliders: Sequence[HostCollider] = (),
             motions: Sequence[Motion] = (), blade: Optional[Blade] = None) -> None:
        """Takes `count` steps with this input and waits for them; dt [s] and gravity [m/s^2] are by default those of the scene."""
    def reset(self) -> None: ...
    def update_skin(self) -> None:
        """Computes skin_vertices of the newest state."""
    def save(self) -> State: ...
    def load(self, state: State) -> None: ...
    def status(self) -> dict[str, Any]:
        """Figures of the newest step; empty before the first one."""
    def impulses(self) -> NDArray[np.float32]:
        """Impulses on bodies in the newest step (Settings.keeps_forces): (bodies, 5, 2, 3), by contacts, planes, colliders, holds and
        grabs, linear [N s] and angular [N m s]."""
    def blade_impulse(self) -> NDArray[np.float32]:
        """The impulse on the blade of the newest step [N s], by `toughness` of what it cut (Settings.keeps_forces): (3,)."""
    def events(self) -> list[dict[str, Any]]:
        """What happened in the steps of the last step() (Settings.events), oldest first: step, kind, body and count; of contacts also
        partner ("body", "plane", "host_collider", "collider") and other, its index. As SinewEvent in sinew_events.h."""
    def complaints(self) -> list[str]:
        """Sentences on input that was ignored, each kind once."""
    @property
    def positions(self) -> NDArray[np.float32]:
        """(n, 4): position [m] and inverse mass [1/kg], 0 while the particle sleeps."""
    @property
    def velocities(self) -> NDArray[np.float32]:
        """(n, 4): velocity [m/s], 0."""
    @property
    def previous_positions(self) -> NDArray[np.float32]:
        """Positions at the start of the newest step; empty without Settings.keeps_previous."""
    @property
    def previous_skin_vertices(self) -> NDArray[np.float32]:
        """What skin_vertices were before the newest update_skin(); empty without Settings.keeps_previous."""
    @property
    def skin_vertices(self) -> NDArray[np.float32]:
        """(n, 8): position [m], 1, normal, 0 of the skins, after update_skin()."""
    @property
    def skin_indices(self) -> NDArray[np.uint32]: ...
    @property
    def texture_coordinates(self) -> NDArray[np.float32]:
        """(n, 2): u, v of each of skin_indices; empty if no mesh has texture coordinates."""
    @property
    def cut_vertices(self) -> NDArray[np.float32]:
        """(n, 8): as skin_vertices, of the surface of cuts."""
    @property
    def cut_rest(self) -> NDArray[np.float32]:
        """(n, 16) of cut_vertices: place in the uncut body [m], index of the skin, and 12 words of the simulation's own."""
    @property
    def cut_indices(self) -> NDArray[np.uint32]: ...
    @property
    def cut_draws(self) -> NDArray[np.uint32]:
        """(2, 5) of the inside and of pieces of skins: number of indices, 1, the first one in cut_indices, 0, 0."""
    @property
    def cut_texture_coordinates(self) -> NDArray[np.float32]:
        """(n, 2): u, v of each of cut_vertices that pieces of skins have."""
    @property
    def pieces(self) -> NDArray[np.uint32]:
        """For each particle the one that names its piece; empty if nothing can be cut."""
    @property
    def substeps(self) -> int: ...
    @property
    def steps_done(self) -> int: ...

class Part:
    """Names a part of a world; may be a key of a dict."""

class World:
    """A simulation to which parts are added, and from which they are removed, while it runs. `base` stays for good."""
    def __init__(self, device: Device, base: Scene, settings: Optional[Settings] = None) -> None:
        """Without settings, those of the file of `base`."""
    def add(self, scene: Scene) -> Part:
        """Adds a copy of a scene as a part, at its positions; it arrives before the next step. Each of its particles belongs to a body
        of its own. Gravity, dt and damping are those of the base."""
    def remove(self, part: Part) -> None:
        """Removes a part; it leaves before the next step."""
    def __contains__(self, part: Part) -> bool:
        """Whether the part was added and not removed since."""
    def find(self, part: Part) -> Optional[dict[str, tuple[int, int]]]:
        """First index and number of its elements by kind, as "particles"; None before it has arrived. Raises Error for a part that has
        left."""
    def update(self) -> None:
        """Waits until all changes have arrived: find() then gives the indices that the next step has."""
    def step(self, count: int = 1, dt: Optional[float] = None, gravity: Optional[Vector] = None, anchors: Optional[ArrayLike] = None,
             grabs: Sequence[Grab] = (), fields: Sequence[Field] = (), host_colliders: Sequence[HostCollider] = (),
             motions: Sequence[Motion] = (), blade: Optional[Blade] = None) -> None:
        """update(), then `count` steps as Simulation.step()."""
    def positions(self, part: Optional[Part] = None) -> NDArray[np.float32]:
        """A copy for a part, or for all: (n, 4), position [m] and inverse mass [1/kg], 0 while the particle sleeps."""
    def velocities(self, part: Optional[Part] = None) -> NDArray[np.float32]:
        """A copy for a part, or for all: (n, 4), velocity [m/s], 0."""
    def pick(self, origin: Vector, direction: Vector, length: float = 0.0, skips_fixed: bool = False) -> Optional[dict[str, Any]]:
        """What a ray from `origin` [m] along `direction`, a unit vector, meets first within `length` [m] (0 = anywhere), or None: the
        nearest particle, its body (or None), point and distance [m] along the ray, place of the particle [m]. Rays meet skins, balls
        of bodies without a skin, and surfaces of cuts."""
    def overlap(self, center: Vector, half_extents: Vector = (0, 0, 0), radius: float = 0.0, skips_fixed: bool = False) -> NDArray[np.uint32]:
        """The particles inside a box along the axes around `center`, grown by `radius` [m], ascending; a sphere without extents."""
    def events(self) -> list[dict[str, Any]]:
        """As Simulation.events()."""
    def impulses(self) -> NDArray[np.float32]:
        """As Simulation.impulses(), by Body of all parts in their order."""
    def blade_impulse(self) -> NDArray[np.float32]:
        """As Simulation.blade_impulse()."""
    def counts(self) -> dict[str, int]:
        """Number of elements of each kind."""
    @property
    def is_changing(self) -> bool:
        """Whether changes have not arrived yet."""
    @property
    def take_overs(self) -> int:
        """How often changes have arrived: each time indices are new."""
    @property
    def substeps(self) -> int: ...
    @property
    def steps_done(self) -> int: ...

def run(scene: Union[str, os.PathLike[str]], frames: int = 240, **options: Any) -> dict[str, Any]:
    """Runs a scene file or mesh by the program `sinew` and returns the report (docs/report.md)."""
def describe(scene: Union[Scene, str, os.PathLike[str]], settings: Optional[Settings] = None) -> str:
    """The passes, buffers and barriers of a step, as text."""
def study(scene: str, out: Union[str, os.PathLike[str], None] = None, **options: Any) -> dict[str, Any]:
    """Measures speed against error of every solver by the program `sinew` and returns the report. `out` keeps its folder."""
