// The table itself. Ranges that the simulation shares come from sinew/ranges.hpp.
#include "scenes/schema.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace sinew::scenes {

namespace {

namespace ranges = sim::ranges;
using sim::Range;

constexpr Range coordinate{-1e6, 1e6};
constexpr Range direction{-1, 1};
constexpr Range length{.low = 0, .high = 1e6, .isLowOpen = true};
constexpr Range reach{0, 1e6}, moment{0, 1e6};
constexpr Range density{.low = 0, .high = 1e6, .isLowOpen = true};
constexpr Range stiffness{.low = 0, .high = 1e15, .isLowOpen = true};
constexpr Range membrane{0, 1e15}, bending{0, 1e6}, tethers{0, 8};
constexpr Range angle{-360, 360};
constexpr Range side{2, 4096}, chainLength{2, 100'000}, cellsAlong{1, 512}, detail{8, 256},
    particleBudget{8, 2'000'000};
constexpr Range place{1, 1000};
constexpr Range rowLength{1, 4096}, copies{1, 4096}, particleNumber{1, 2'000'000}, seed{0, 1e6},
    strokeCount{1, 10'000};
constexpr Range jitter{0, 1e6}, speed{-1e6, 1e6};
constexpr Range mass{.low = 0, .high = 1e9, .isLowOpen = true}, load{0, 1e9};
constexpr Range time{0, 1e6};
constexpr Range view{.low = 0, .high = 180, .isLowOpen = true, .isHighOpen = true};

constexpr KindRule kindRules[] = {
    {Kind::text, "text in quotes", 0, false},
    {Kind::number, "a number", 1, false},
    {Kind::count, "a whole number", 1, true},
    {Kind::countOrAuto, "a whole number or \"auto\"", 1, true},
    {Kind::vector, "three numbers [x, y, z]", 3, false},
    {Kind::counts2, "two whole numbers", 2, true},
    {Kind::counts3, "three whole numbers", 3, true},
    {Kind::pins, "a list of corner or edge names and [column, row] pairs", 0, false},
    {Kind::names, "a list of names in quotes", 0, false},
    {Kind::nameOrNames, "a name or a list of names in quotes", 0, false},
    {Kind::flag, "true or false", 0, false},
    {Kind::numbers, "a list of numbers", 0, false},
    {Kind::lines, "a list of poly-lines [[x, y, z], ...]", 0, false},
    {Kind::table, "a table", 0, false},
    {Kind::tables, "a list of tables", 0, false},
};

// clang-format off
constexpr Key keys[] = {
    // section, name, kind, unit, range, fallback, meaning, isRequired
    {"", "name", Kind::text, "", {}, "", "name of the scene in reports; the file's name if missing"},
    {"", "gravity", Kind::vector, "m/s^2", coordinate, "[0, -9.81, 0]", "acceleration of everything that moves"},
    {"", "dt", Kind::number, "s", ranges::dt, "0.016666667", "length of a step"},
    {"", "damping", Kind::number, "1/s", ranges::damping, "0", "rate c at which velocities decay, exp(-c t)"},
    {"", "damping_time", Kind::number, "s", ranges::dampingTime, "0", "internal damping of links, proportional to their stiffness: a vibration of angular frequency w is damped by the ratio w damping_time / 2"},
    {"", "solver", Kind::table, "", {}, "", "solver and its settings"},
    {"", "cloth", Kind::tables, "", {}, "", "rectangular sheets"},
    {"", "chain", Kind::tables, "", {}, "", "masses in a line"},
    {"", "box", Kind::tables, "", {}, "", "cuboids of voxels"},
    {"", "mesh", Kind::tables, "", {}, "", "triangle meshes filled with voxels"},
    {"", "particles", Kind::tables, "", {}, "", "loose particles that touch each other"},
    {"", "mesh_collider", Kind::tables, "", {}, "", "triangle meshes that particles touch, static or moving"},
    {"", "hold", Kind::tables, "", {}, "", "regions whose particles are held in place or moved along a path"},
    {"", "plane", Kind::tables, "", {}, "", "half spaces that contain the particles"},
    {"", "collider", Kind::tables, "", {}, "", "spheres, capsules and boxes that particles cannot enter, static or moving"},
    {"", "contacts", Kind::table, "", {}, "", "contact settings"},
    {"", "report", Kind::table, "", {}, "", "additional results of a run"},
    {"", "debris", Kind::count, "particles", ranges::debris, "0", "pieces of a box, a mesh or a cloth with fewer particles than this are removed when they are cut off: they are no longer touched, held, drawn or exported; 0 = none"},
    {"", "cut_surface_room", Kind::count, "triangles", ranges::cutSurfaceRoom, "0", "initial capacity for the surface of cuts, if larger than the default for some cuts through the whole of each body; programs enlarge it when needed"},
    {"", "blade", Kind::tables, "", {}, "", "blades that cut at given times"},
    {"", "strokes", Kind::tables, "", {}, "", "many blades at random places"},
    {"", "camera", Kind::table, "", {}, "", "viewpoint of a picture"},
    {"", "gallery", Kind::table, "", {}, "", "the scene in lists and in docs/gallery.md"},
    {"", "tools", Kind::table, "", {}, "", "how the tools of the viewer begin"},

    {"solver", "name", Kind::text, "", {}, "\"split\"", "split, jacobi or gauss_seidel"},
    {"solver", "substeps", Kind::countOrAuto, "", ranges::substeps, "\"auto\"", "equal parts of a step; more are stiffer and more exact. \"auto\": as many as the tolerance requires, from 4 to 256"},
    {"solver", "tolerance", Kind::number, "", ranges::tolerance, "0.05", "substeps = \"auto\": share by which a link may be softer than requested"},
    {"solver", "iterations", Kind::count, "", ranges::iterations, "1", "jacobi, gauss_seidel: sweeps per substep"},
    {"solver", "omega", Kind::number, "", ranges::omega, "2", "split: stiffness clamp, below 4 / (1 + 2 theta)"},
    {"solver", "theta", Kind::number, "", ranges::theta, "0.1", "split: 0 conserves energy, larger values damp vibrations"},
    {"solver", "levels", Kind::countOrAuto, "", ranges::levels, "0", "split: coarse levels of bodies on grids, which carry the stiffness that a substep is too long for. \"auto\": as many as win at equal error"},
    {"solver", "sharp_clamp", Kind::flag, "", {}, "true", "split: links are clamped by the directions in which they meet; false: as if all were parallel, which takes 1.7 times the substeps in solids and 1.4 times in sheets for the same error. Without effect where there are levels or internal damping"},
    {"solver", "weight", Kind::number, "", ranges::weight, "0", "jacobi: factor on a particle's summed corrections; 0 = 1 / their number"},
    {"solver", "over_relaxation", Kind::number, "", ranges::overRelaxation, "1", "jacobi: second factor on that sum"},
    {"solver", "warm_start", Kind::number, "", ranges::warmStart, "0.9", "gauss_seidel: largest share of the multipliers of the last substep with which a substep starts; 0 = cold"},
    {"solver", "sleep", Kind::flag, "", {}, "false", "split: bodies at rest for half a second sleep, and cost nothing until something wakes them"},

    {"cloth", "name", Kind::text, "", {}, "\"cloth\"", "name of the body in reports and files"},
    {"cloth", "origin", Kind::vector, "m", coordinate, "[0, 0, 0]", "position of the particle in column 0, row 0"},
    {"cloth", "right", Kind::vector, "", direction, "[1, 0, 0]", "unit direction of a row"},
    {"cloth", "down", Kind::vector, "", direction, "[0, 0, 1]", "unit direction of a column, at right angles to right"},
    {"cloth", "size", Kind::counts2, "particles", side, "[64, 64]", "columns and rows"},
    {"cloth", "spacing", Kind::number, "m", length, "", "distance of neighbours in a row or column", true},
    {"cloth", "area_density", Kind::number, "kg/m^2", density, "0.2", "mass per area"},
    {"cloth", "stretch_compliance", Kind::number, "m/N", ranges::compliance, "0", "compliance of the links along rows and columns; 0 = as stiff as the solver can"},
    {"cloth", "shear_compliance", Kind::number, "m/N", ranges::compliance, "0", "compliance of the diagonal links"},
    {"cloth", "membrane_stiffness", Kind::number, "N/m", membrane, "0", "Young's modulus times thickness of an isotropic sheet (Poisson's ratio 1/3), instead of the two compliances; 0 = use the compliances"},
    {"cloth", "skip_stiffness", Kind::number, "N/m", ranges::skipStiffness, "0", "stiffness of links to the next but one in a row or column, which resist folding; 0 = none"},
    {"cloth", "bending_stiffness", Kind::number, "N m", bending, "0", "bending stiffness of rows and columns; 0 = none"},
    {"cloth", "tethers", Kind::count, "", tethers, "0", "number of tethers from each particle to the nearest pinned ones, so that a heavy sheet does not stretch"},
    {"cloth", "pinned", Kind::pins, "", {}, "[]", "particles held in place"},
    {"cloth", "collides", Kind::flag, "", {}, "", "whether its particles touch others, in split; if missing, those of a cuttable sheet without thickness do"},
    {"cloth", "radius", Kind::number, "m", length, "", "radius of a particle that touches others, at most half of the spacing; half of it if missing"},
    {"cloth", "friction", Kind::number, "", ranges::friction, "", "Coulomb's kinetic coefficient; a pair has the geometric mean of both; that of [contacts] if missing"},
    {"cloth", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient, combined like friction; equal to friction if missing or smaller"},
    {"cloth", "restitution", Kind::number, "", ranges::restitution, "", "0 = no rebound, 1 = elastic; a pair has the larger of both; that of [contacts] if missing"},
    {"cloth", "rest_contact", Kind::text, "", {}, "", "contacts and overlaps that exist at load: part, or keep their distance; that of [contacts] if missing"},
    {"cloth", "thickness", Kind::number, "m", length, "", "thickness of a sheet whose triangles touch particles, meshes, other sheets and itself; instead of collides and radius"},
    {"cloth", "cuttable", Kind::flag, "", {}, "false", "whether a blade may cut the body"},
    {"cloth", "tear", Kind::number, "", ranges::tearStrain, "0", "strain in any direction beyond which a cuttable body tears; 0 = never"},
    {"cloth", "tears_per_step", Kind::count, "cells", ranges::tearsPerStep, "16", "most cells that tear in a step: the most stretched ones"},
    {"cloth", "toughness", Kind::number, "J/m", ranges::toughness, "0", "work of a blade for each length that it cuts, of the body at rest: the force on the blade in the report; changes no motion"},
    {"cloth", "velocity", Kind::vector, "m/s", speed, "[0, 0, 0]", "velocity of the centre of mass at the start"},
    {"cloth", "spin", Kind::vector, "rad/s", speed, "[0, 0, 0]", "angular velocity about the centre of mass at the start"},
    {"cloth", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle of the sheet"},
    {"cloth", "absent", Kind::flag, "", {}, "false", "whether the body starts outside of the world, for a host that spawns it"},
    {"cloth", "color", Kind::vector, "", ranges::color, "[0.16, 0.34, 0.58]", "linear red, green and blue"},

    {"chain", "name", Kind::text, "", {}, "\"chain\"", "name of the body in reports and files"},
    {"chain", "origin", Kind::vector, "m", coordinate, "[0, 0, 0]", "position of the first particle"},
    {"chain", "direction", Kind::vector, "", direction, "[0, -1, 0]", "unit direction from the first particle to the last"},
    {"chain", "particles", Kind::count, "particles", chainLength, "100", "number of particles"},
    {"chain", "length", Kind::number, "m", length, "", "distance from the first particle to the last", true},
    {"chain", "mass", Kind::number, "kg", mass, "0.1", "mass of all particles if the last were like the others"},
    {"chain", "end_mass", Kind::number, "kg", mass, "", "mass of the last particle; like the others if missing"},
    {"chain", "stretch_compliance", Kind::number, "m/N", ranges::compliance, "0", "compliance of a link; 0 = as stiff as the solver can"},
    {"chain", "pinned", Kind::names, "", {}, "[\"first\"]", "ends held in place: \"first\", \"last\""},
    {"chain", "velocity", Kind::vector, "m/s", speed, "[0, 0, 0]", "velocity of the centre of mass at the start"},
    {"chain", "spin", Kind::vector, "rad/s", speed, "[0, 0, 0]", "angular velocity about the centre of mass at the start"},
    {"chain", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle of the chain"},

    {"box", "name", Kind::text, "", {}, "\"box\"", "name of the body in reports and files"},
    {"box", "center", Kind::vector, "m", coordinate, "", "middle of the box; give this or origin"},
    {"box", "origin", Kind::vector, "m", coordinate, "", "lowest corner of the box; give this or center"},
    {"box", "particles", Kind::counts3, "particles", side, "[16, 16, 16]", "particles along x, y and z"},
    {"box", "spacing", Kind::number, "m", length, "", "distance of neighbours along an axis", true},
    {"box", "young_modulus", Kind::number, "Pa", stiffness, "1e5", "stiffness of the material"},
    {"box", "poisson_ratio", Kind::number, "", ranges::poissonRatio, "0.25", "ratio of thinning to stretch; near 1/2 the volume is kept, and more substeps are needed"},
    {"box", "recovery", Kind::number, "", ranges::recovery, "0", "pressure in shear moduli that unfolds flattened and mirrored cells; 0 = none, 2 is enough"},
    {"box", "density", Kind::number, "kg/m^3", density, "1000", "mass per volume"},
    {"box", "clamped", Kind::names, "", {}, "[]", "faces whose particles are held in place"},
    {"box", "load", Kind::number, "kg", load, "0", "additional mass of the upper face, distributed evenly over its particles"},
    {"box", "collides", Kind::flag, "", {}, "", "whether its particles touch others; if missing, those of a cuttable body do"},
    {"box", "radius", Kind::number, "m", length, "", "radius of a particle that touches others, at most half of the spacing; half of it if missing"},
    {"box", "faces", Kind::flag, "", {}, "", "whether the surface between its particles touches others too; if missing, it does when colliding particles could pass between its own"},
    {"box", "friction", Kind::number, "", ranges::friction, "", "Coulomb's kinetic coefficient; a pair has the geometric mean of both; that of [contacts] if missing"},
    {"box", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient, combined like friction; equal to friction if missing or smaller"},
    {"box", "restitution", Kind::number, "", ranges::restitution, "", "0 = no rebound, 1 = elastic; a pair has the larger of both; that of [contacts] if missing"},
    {"box", "rest_contact", Kind::text, "", {}, "", "contacts and overlaps that exist at load: part, or keep their distance; that of [contacts] if missing"},
    {"box", "copies", Kind::counts3, "", copies, "[1, 1, 1]", "numbers of boxes along x, y and z, instead of one"},
    {"box", "pitch", Kind::vector, "m", coordinate, "", "distances from one box to the next along x, y and z; the side and two spacings if missing"},
    {"box", "cuttable", Kind::flag, "", {}, "false", "whether a blade may cut the body"},
    {"box", "tear", Kind::number, "", ranges::tearStrain, "0", "strain in any direction beyond which a cuttable body tears; 0 = never"},
    {"box", "tears_per_step", Kind::count, "cells", ranges::tearsPerStep, "16", "most cells that tear in a step: first those that a cut has reached, then the most stretched ones"},
    {"box", "toughness", Kind::number, "J/m^2", ranges::toughness, "0", "work of a blade for each area that it cuts, of the body at rest: the force on the blade in the report; changes no motion"},
    {"box", "velocity", Kind::vector, "m/s", speed, "[0, 0, 0]", "velocity of the centre of mass at the start"},
    {"box", "spin", Kind::vector, "rad/s", speed, "[0, 0, 0]", "angular velocity about the centre of mass at the start"},
    {"box", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle of the box; each copy around its own"},
    {"box", "absent", Kind::flag, "", {}, "false", "whether the body starts outside of the world, for a host that spawns it"},
    {"box", "color", Kind::vector, "", ranges::color, "[0.78, 0.36, 0.32]", "linear red, green and blue; every second copy is darker"},

    {"mesh", "name", Kind::text, "", {}, "", "name of the body in reports and files; that of the mesh file or shape if missing"},
    {"mesh", "file", Kind::text, "", {}, "", "mesh file in the scene's folder or below, or \"argument\": the mesh of the command line"},
    {"mesh", "generate", Kind::text, "", {}, "", "a built-in shape instead of a file"},
    {"mesh", "detail", Kind::count, "edges", detail, "96", "generate: triangle edges along the longest side"},
    {"mesh", "object", Kind::nameOrNames, "", {}, "", "objects of the file, or its components: \"part 1\" is the largest; all if missing"},
    {"mesh", "repair", Kind::text, "", {}, "\"close\"", "repair of the file: none; weld: near vertices are joined and T-junctions split; close: also leftovers removed, small holes closed, flipped triangles and parts reversed"},
    {"mesh", "weld", Kind::number, "", length, "", "distance within which open edges are joined, in units of the file; a hundred-thousandth of its size if missing"},
    {"mesh", "unit", Kind::text, "", {}, "\"m\"", "unit of the coordinates in the file: um, mm, cm, m, in or ft"},
    {"mesh", "scale", Kind::number, "", length, "1", "factor on the coordinates, in addition to unit"},
    {"mesh", "size", Kind::number, "m", length, "", "the longest side is scaled to this length; instead of unit and scale"},
    {"mesh", "center", Kind::vector, "m", coordinate, "", "new position of the middle of the bounding box; unmoved if missing"},
    {"mesh", "translation", Kind::vector, "m", coordinate, "", "added to the coordinates after unit, scale and rotation, instead of center; the rotation is then around the origin of the file"},
    {"mesh", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle"},
    {"mesh", "voxel", Kind::number, "m", length, "", "edge of a voxel; give this, resolution or particles"},
    {"mesh", "resolution", Kind::count, "voxels", cellsAlong, "24", "voxels along the longest side"},
    {"mesh", "particles", Kind::count, "", particleBudget, "", "most particles: the finest voxels that make no more are used"},
    {"mesh", "parts", Kind::text, "", {}, "\"joined\"", "\"joined\": one body; \"apart\": a body for each component of the mesh, all with the same voxels"},
    {"mesh", "young_modulus", Kind::number, "Pa", stiffness, "6e4", "stiffness of the material"},
    {"mesh", "poisson_ratio", Kind::number, "", ranges::poissonRatio, "0.25", "ratio of thinning to stretch; near 1/2 the volume is kept, and more substeps are needed"},
    {"mesh", "recovery", Kind::number, "", ranges::recovery, "2", "pressure in shear moduli that unfolds flattened and mirrored cells; 0 = none, also used if the key is missing and recovery cannot be computed"},
    {"mesh", "density", Kind::number, "kg/m^3", density, "1000", "mass per volume"},
    {"mesh", "collides", Kind::flag, "", {}, "", "whether its particles touch others, with a radius of half a voxel; if missing, those of a cuttable body do"},
    {"mesh", "faces", Kind::flag, "", {}, "", "whether the surface between its particles touches others too; if missing, it does when colliding particles could pass between its own"},
    {"mesh", "friction", Kind::number, "", ranges::friction, "", "Coulomb's kinetic coefficient; a pair has the geometric mean of both; that of [contacts] if missing"},
    {"mesh", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient, combined like friction; equal to friction if missing or smaller"},
    {"mesh", "restitution", Kind::number, "", ranges::restitution, "", "0 = no rebound, 1 = elastic; a pair has the larger of both; that of [contacts] if missing"},
    {"mesh", "rest_contact", Kind::text, "", {}, "", "contacts and overlaps that exist at load: part, or keep their distance; that of [contacts] if missing"},
    {"mesh", "cuttable", Kind::flag, "", {}, "false", "whether a blade may cut the body"},
    {"mesh", "tear", Kind::number, "", ranges::tearStrain, "0", "strain in any direction beyond which a cuttable body tears; 0 = never"},
    {"mesh", "tears_per_step", Kind::count, "cells", ranges::tearsPerStep, "16", "most cells that tear in a step: first those that a cut has reached, then the most stretched ones"},
    {"mesh", "toughness", Kind::number, "J/m^2", ranges::toughness, "0", "work of a blade for each area that it cuts, of the body at rest: the force on the blade in the report; changes no motion"},
    {"mesh", "velocity", Kind::vector, "m/s", speed, "[0, 0, 0]", "velocity of the centre of mass at the start"},
    {"mesh", "spin", Kind::vector, "rad/s", speed, "[0, 0, 0]", "angular velocity about the centre of mass at the start"},
    {"mesh", "absent", Kind::flag, "", {}, "false", "whether the body starts outside of the world, for a host that spawns it"},
    {"mesh", "color", Kind::vector, "", ranges::color, "[0.78, 0.36, 0.32]", "linear red, green and blue"},

    {"particles", "name", Kind::text, "", {}, "\"particles\"", "name of the body in reports and files"},
    {"particles", "center", Kind::vector, "m", coordinate, "[0, 0, 0]", "middle of the rows or of the cuboid"},
    {"particles", "count", Kind::counts3, "particles", rowLength, "[10, 10, 10]", "numbers of particles in rows along x, y and z"},
    {"particles", "spacing", Kind::number, "m", length, "", "spacing of rows; the smallest possible, 2 (radius + jitter), if missing"},
    {"particles", "jitter", Kind::number, "m", jitter, "0", "largest random offset of a particle along each axis"},
    {"particles", "random", Kind::count, "particles", particleNumber, "", "instead of rows: number of particles at random places in a cuboid, none overlapping"},
    {"particles", "size", Kind::vector, "m", length, "", "random: sides of the cuboid that holds the balls, which may fill a third of it"},
    {"particles", "seed", Kind::count, "", seed, "1", "seed of jitter and random places"},
    {"particles", "radius", Kind::number, "m", length, "", "radius of a particle: two touch at twice that distance", true},
    {"particles", "density", Kind::number, "kg/m^3", density, "1000", "density of a ball of that radius; give this or mass"},
    {"particles", "mass", Kind::number, "kg", mass, "", "mass of a particle; give this or density"},
    {"particles", "velocity", Kind::vector, "m/s", speed, "[0, 0, 0]", "velocity of the centre of mass at the start"},
    {"particles", "spin", Kind::vector, "rad/s", speed, "[0, 0, 0]", "angular velocity about the centre of mass at the start"},
    {"particles", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle of the particles"},
    {"particles", "friction", Kind::number, "", ranges::friction, "", "Coulomb's kinetic coefficient; a pair has the geometric mean of both; that of [contacts] if missing"},
    {"particles", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient, combined like friction; equal to friction if missing or smaller"},
    {"particles", "restitution", Kind::number, "", ranges::restitution, "", "0 = no rebound, 1 = elastic; a pair has the larger of both; that of [contacts] if missing"},
    {"particles", "rest_contact", Kind::text, "", {}, "", "contacts and overlaps that exist at load: part, or keep their distance; that of [contacts] if missing"},
    {"particles", "color", Kind::vector, "", ranges::color, "[0.62, 0.62, 0.6]", "linear red, green and blue"},

    {"report", "forces", Kind::flag, "", {}, "false", "without sleep: the forces and torques of contacts, planes, colliders, holds and grabs in the last step"},
    {"contacts", "friction", Kind::number, "", ranges::friction, "0", "Coulomb's kinetic coefficient between particles and of faces"},
    {"contacts", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient; equal to friction if missing or smaller"},
    {"contacts", "restitution", Kind::number, "", ranges::restitution, "0", "0 = no rebound, 1 = elastic"},
    {"contacts", "recovery_speed", Kind::number, "m/s", ranges::recoverySpeed, "0.5", "speed at which overlaps that exist at load part: of particles, faces, edges; limits no other contact"},
    {"contacts", "take_recoils_back", Kind::flag, "", {}, "false", "loose balls without restitution stay down: pushes that part overlaps become no speed"},
    {"contacts", "rest_contact", Kind::text, "", {}, "\"part\"", "contacts and overlaps that exist at load: \"part\" with recovery_speed, \"keep\" their distance as a rest distance; a pair keeps it if either body does"},
    {"contacts", "margin", Kind::number, "median radii", ranges::contactMargin, "0.5", "extra distance up to which pairs are listed as candidates; changes the speed, not the result"},
    {"contacts", "room", Kind::count, "candidates", ranges::contactRoom, "8", "initial capacity of the lists for a particle, a point or an edge, on average, less by default where it would take more than 128 MiB; a single one may have far more; programs enlarge it when needed, as far as the device can bind"},

    {"mesh_collider", "name", Kind::text, "", {}, "", "name of the body in reports and files; that of the mesh file or shape if missing"},
    {"mesh_collider", "file", Kind::text, "", {}, "", "mesh file in the scene's folder or below, or \"argument\": the mesh of the command line"},
    {"mesh_collider", "generate", Kind::text, "", {}, "", "a built-in shape instead of a file"},
    {"mesh_collider", "detail", Kind::count, "edges", detail, "32", "generate: triangle edges along the longest side"},
    {"mesh_collider", "object", Kind::nameOrNames, "", {}, "", "objects of the file, or its components: \"part 1\" is the largest; all if missing"},
    {"mesh_collider", "repair", Kind::text, "", {}, "\"close\"", "repair of the file: none; weld: near vertices are joined and T-junctions split; close: also leftovers removed, small holes closed, flipped triangles and parts reversed"},
    {"mesh_collider", "weld", Kind::number, "", length, "", "distance within which open edges are joined, in units of the file; a hundred-thousandth of its size if missing"},
    {"mesh_collider", "unit", Kind::text, "", {}, "\"m\"", "unit of the coordinates in the file: um, mm, cm, m, in or ft"},
    {"mesh_collider", "scale", Kind::number, "", length, "1", "factor on the coordinates, in addition to unit"},
    {"mesh_collider", "size", Kind::number, "m", length, "", "the longest side is scaled to this length; instead of unit and scale"},
    {"mesh_collider", "center", Kind::vector, "m", coordinate, "", "new position of the middle of the bounding box; unmoved if missing"},
    {"mesh_collider", "translation", Kind::vector, "m", coordinate, "", "added to the coordinates after unit, scale and rotation, instead of center; the rotation is then around the origin of the file"},
    {"mesh_collider", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle"},
    {"mesh_collider", "thickness", Kind::number, "m", length, "0.002", "distance that particles keep from the triangles, in addition to their radius"},
    {"mesh_collider", "friction", Kind::number, "", ranges::friction, "", "Coulomb's kinetic coefficient; a pair has the geometric mean of both; that of [contacts] if missing"},
    {"mesh_collider", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient, combined like friction; equal to friction if missing or smaller"},
    {"mesh_collider", "restitution", Kind::number, "", ranges::restitution, "", "0 = no rebound, 1 = elastic; a pair has the larger of both; that of [contacts] if missing"},
    {"mesh_collider", "rest_contact", Kind::text, "", {}, "", "contacts and overlaps that exist at load: part, or keep their distance; that of [contacts] if missing"},
    {"mesh_collider", "keyframe", Kind::tables, "", {}, "", "poses at given times; static without them"},
    {"mesh_collider", "path_end", Kind::text, "", {}, "\"hold\"", "motion after the last keyframe: \"hold\" stays there, \"loop\" starts again with the first, which must have the same pose"},
    {"mesh_collider", "color", Kind::vector, "", ranges::color, "[0.55, 0.53, 0.5]", "linear red, green and blue"},

    {"mesh_collider.keyframe", "time", Kind::number, "s", moment, "", "time since the start of the simulation; later than the previous keyframe", true},
    {"mesh_collider.keyframe", "center", Kind::vector, "m", coordinate, "", "position of the middle; that of the mesh collider if missing"},
    {"mesh_collider.keyframe", "rotation", Kind::vector, "degrees", angle, "", "rotation, defined like that of the mesh collider, which is used if missing; at most 170 from one keyframe to the next"},

    {"hold", "name", Kind::text, "", {}, "\"hold\"", "name of the hold in messages"},
    {"hold", "bodies", Kind::names, "", {}, "[]", "names of the bodies whose particles it takes; all bodies if missing"},
    {"hold", "shape", Kind::text, "", {}, "", "sphere, capsule, box, half_space or mesh", true},
    {"hold", "center", Kind::vector, "m", coordinate, "[0, 0, 0]", "position of its middle, the pivot of a path; for a mesh that of its bounding box, unmoved if missing"},
    {"hold", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle"},
    {"hold", "radius", Kind::number, "m", length, "", "sphere: radius; capsule: radius, also of its round ends"},
    {"hold", "length", Kind::number, "m", reach, "", "capsule: length along its y, without its round ends"},
    {"hold", "size", Kind::vector, "m", length, "", "box: lengths of its sides"},
    {"hold", "normal", Kind::vector, "", direction, "", "half_space: unit normal; the hold takes the particles on the side that it points to"},
    {"hold", "offset", Kind::number, "m", coordinate, "0", "half_space: distance of its plane from the origin along the normal"},
    {"hold", "file", Kind::text, "", {}, "", "mesh: a file in the scene's folder or below"},
    {"hold", "object", Kind::nameOrNames, "", {}, "", "mesh: objects of the file, or its components; all if missing"},
    {"hold", "repair", Kind::text, "", {}, "\"close\"", "mesh: repair of the file: none; weld: near vertices are joined and T-junctions split; close: also leftovers removed, small holes closed, flipped triangles and parts reversed"},
    {"hold", "weld", Kind::number, "", length, "", "mesh: distance within which open edges are joined, in units of the file; a hundred-thousandth of its size if missing"},
    {"hold", "unit", Kind::text, "", {}, "\"m\"", "mesh: unit of its coordinates: um, mm, cm, m, in or ft"},
    {"hold", "scale", Kind::number, "", length, "1", "mesh: factor on its coordinates, in addition to unit"},
    {"hold", "translation", Kind::vector, "m", coordinate, "", "mesh: added to its coordinates after unit, scale and rotation, instead of center; the rotation is then around the origin of the file"},
    {"hold", "within", Kind::number, "m", reach, "", "mesh: the hold takes the particles inside or within this distance of its triangles"},
    {"hold", "keyframe", Kind::tables, "", {}, "", "poses of the middle at given times; no motion without them"},
    {"hold", "path_end", Kind::text, "", {}, "\"hold\"", "motion after the last keyframe: \"hold\" stays there, \"loop\" starts again with the first, which must have the same pose"},

    {"hold.keyframe", "time", Kind::number, "s", moment, "", "time since the start of the simulation; later than the previous keyframe", true},
    {"hold.keyframe", "center", Kind::vector, "m", coordinate, "", "position of the middle; that of the hold if missing"},
    {"hold.keyframe", "rotation", Kind::vector, "degrees", angle, "", "rotation, defined like that of the hold, which is used if missing; at most 170 from one keyframe to the next"},

    {"plane", "normal", Kind::vector, "", direction, "[0, 1, 0]", "unit length, points to the free side"},
    {"plane", "offset", Kind::number, "m", coordinate, "0", "distance of the plane from the origin along the normal"},
    {"plane", "friction", Kind::number, "", ranges::friction, "0", "Coulomb's kinetic coefficient"},
    {"plane", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient; equal to friction if missing or smaller"},
    {"plane", "restitution", Kind::number, "", ranges::restitution, "0", "0 = no rebound, 1 = elastic"},

    {"collider", "shape", Kind::text, "", {}, "", "sphere, capsule or box", true},
    {"collider", "center", Kind::vector, "m", coordinate, "[0, 0, 0]", "position of its middle"},
    {"collider", "rotation", Kind::vector, "degrees", angle, "[0, 0, 0]", "about x, then y, then z, around the middle"},
    {"collider", "radius", Kind::number, "m", length, "", "sphere: radius; capsule: radius, also of its round ends"},
    {"collider", "length", Kind::number, "m", reach, "", "capsule: length along its y, without its round ends"},
    {"collider", "size", Kind::vector, "m", length, "", "box: lengths of its sides"},
    {"collider", "margin", Kind::number, "m", reach, "0", "distance kept from the surface, such as half the thickness of a cloth"},
    {"collider", "friction", Kind::number, "", ranges::friction, "0", "Coulomb's kinetic coefficient"},
    {"collider", "static_friction", Kind::number, "", ranges::friction, "", "static coefficient; equal to friction if missing or smaller"},
    {"collider", "restitution", Kind::number, "", ranges::restitution, "0", "0 = no rebound, 1 = elastic"},
    {"collider", "keyframe", Kind::tables, "", {}, "", "poses at given times; static without them"},
    {"collider", "path_end", Kind::text, "", {}, "\"hold\"", "motion after the last keyframe: \"hold\" stays there, \"loop\" starts again with the first, which must have the same pose"},
    {"collider", "color", Kind::vector, "", ranges::color, "[0.45, 0.45, 0.48]", "linear red, green and blue"},

    {"collider.keyframe", "time", Kind::number, "s", moment, "", "time since the start of the simulation; later than the previous keyframe", true},
    {"collider.keyframe", "center", Kind::vector, "m", coordinate, "", "position of the middle; that of the collider if missing"},
    {"collider.keyframe", "rotation", Kind::vector, "degrees", angle, "", "rotation, defined like that of the collider, which is used if missing; at most 170 from one keyframe to the next"},

    {"blade", "name", Kind::text, "", {}, "\"blade\"", "name of the blade"},
    {"blade", "times", Kind::numbers, "s", time, "", "times of the poses in `edges`, at least two, ascending", true},
    {"blade", "edges", Kind::lines, "m", coordinate, "", "the edge at each of the times, a poly-line of 2 to 256 points, the same number at each time", true},

    {"strokes", "count", Kind::count, "strokes", strokeCount, "", "number of strokes", true},
    {"strokes", "seed", Kind::count, "", seed, "1", "seed of the random strokes"},
    {"strokes", "center", Kind::vector, "m", coordinate, "", "middle of the cuboid in which the middles of strokes lie", true},
    {"strokes", "size", Kind::vector, "m", reach, "", "sides of that cuboid", true},
    {"strokes", "length", Kind::number, "m", length, "", "length of a blade's edge and of its path", true},
    {"strokes", "begin", Kind::number, "s", moment, "0", "start of the first stroke"},
    {"strokes", "every", Kind::number, "s", moment, "0.1", "time between the starts of two strokes, in whole steps"},
    {"strokes", "duration", Kind::number, "s", moment, "", "duration of a stroke, in whole steps; one if missing"},

    {"camera", "eye", Kind::vector, "m", coordinate, "[1.2, 0.8, 1.6]", "position of the camera"},
    {"camera", "target", Kind::vector, "m", coordinate, "[0, 0.2, 0]", "point that it looks at"},
    {"camera", "field_of_view", Kind::number, "degrees", view, "40", "vertical angle of view"},

    {"gallery", "time", Kind::number, "s", moment, "0", "moment that its picture shows"},
    {"gallery", "order", Kind::count, "", place, "", "place among the scenes that come first; if missing, after them under \"More\", by name"},
    {"gallery", "study", Kind::flag, "", {}, "false", "whether it is listed apart, with scenes for studies and tests"},
    {"gallery", "heavy", Kind::flag, "", {}, "false", "whether it is slower than real time on a CPU"},

    {"tools", "blade_depth", Kind::number, "m", length, "", "depth to which the viewer's blade cuts at first, below the surface under the pointer; through the body if missing"},
};
// clang-format on

} // namespace

const KindRule& ruleOf(Kind kind) {
    const auto found = std::ranges::find(kindRules, kind, &KindRule::kind);
    if (found == std::end(kindRules)) throw std::logic_error("a kind of scene key has no rule");
    return *found;
}

std::span<const Key> schema() {
    return keys;
}

const Key* findKey(std::string_view section, std::string_view name) {
    const auto found = std::ranges::find_if(
        keys, [&](const Key& key) { return key.section == section && key.name == name; });
    return found == std::end(keys) ? nullptr : &*found;
}

std::string_view sectionOf(std::string_view section, std::string_view name) {
    const std::string full = (section.empty() ? "" : std::string(section) + ".") + std::string(name);
    const auto found = std::ranges::find(keys, full, &Key::section);
    if (found == std::end(keys)) throw std::logic_error("no scene table is called " + full);
    return found->section;
}

const Key& nearestKey(std::string_view section, std::string_view name) {
    // Keys are short: the head of a monstrous name says as much as the whole.
    const auto distance = [head = name.substr(0, 64), section](const Key& key) {
        return key.section == section ? editDistance(head, key.name) : head.size() + key.name.size() + 1;
    };
    return *std::ranges::min_element(keys, {}, distance);
}

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            const std::size_t replace = cost[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replace});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost[a.size()][b.size()];
}

} // namespace sinew::scenes
