#!/usr/bin/env python3
"""Tests of the Python module, over arrays, files and the program. PYTHONPATH leads to the module."""
import gc
import pathlib
import tempfile
import unittest

import numpy as np

import sinew

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


def cube(height=0.2):
    scene = sinew.Scene()
    scene.add_lattice(cells=(2, 2, 2), origin=(0, height, 0), young_modulus=1e5, skin=True)
    scene.add_plane()
    return scene


class Module(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.device = sinew.Device(software=True)

    def test_device_has_a_name_and_keeps_pipelines(self):
        self.assertTrue(self.device.is_software)
        self.assertIn("llvmpipe", self.device.name)
        again = sinew.Device(software=True, pipeline_cache=self.device.pipeline_cache())
        self.assertEqual(again.name, self.device.name)

    def test_particles_from_arrays_fall_as_bodies_do(self):
        scene = sinew.Scene()
        positions = np.random.default_rng(1).uniform(0, 1, (50, 3))
        velocities = np.tile([0.0, 1.0, 0.0], (50, 1))
        self.assertEqual(scene.add_particles(positions, velocities, inverse_masses=np.full(50, 2.0)), 0)
        scene.gravity = (0, -10, 0)
        scene.dt = 0.01
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(substeps=10))
        simulation.step(20)
        t = 0.2
        expected = positions[:, 1] + t - 5 * t * t
        np.testing.assert_allclose(simulation.positions[:, 1], expected, atol=0.02)
        np.testing.assert_allclose(simulation.positions[:, 3], 2)
        np.testing.assert_allclose(simulation.velocities[:, 1], -1, atol=0.02)
        self.assertEqual((simulation.steps_done, simulation.substeps), (20, 10))

    def test_links_hold_a_pendulum(self):
        scene = sinew.Scene()
        scene.add_particles([[0, 0, 0], [1, 0, 0]])
        scene.add_links(np.array([[0, 1]]), 1.0)
        scene.add_fixed([0])
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(substeps=50))
        simulation.step(30)
        self.assertAlmostEqual(float(np.linalg.norm(simulation.positions[1, :3])), 1, delta=0.01)
        self.assertLess(simulation.positions[1, 1], -0.5)

    def test_arrays_are_views_that_outlive_their_simulation(self):
        simulation = sinew.Simulation(self.device, cube())
        positions = simulation.positions
        before = positions.copy()
        self.assertFalse(positions.flags.owndata)
        self.assertFalse(positions.flags.writeable)
        simulation.step(5)
        self.assertFalse(np.array_equal(positions, before))
        np.testing.assert_array_equal(positions, simulation.positions)
        after = positions.copy()
        del simulation
        gc.collect()
        np.testing.assert_array_equal(positions, after)

    def test_skins_have_unit_normals(self):
        simulation = sinew.Simulation(self.device, cube())
        simulation.step(3)
        simulation.update_skin()
        vertices, indices = simulation.skin_vertices, simulation.skin_indices
        self.assertEqual(indices.size, 3 * 2 * 6 * 4)
        self.assertLess(indices.max(), len(vertices))
        np.testing.assert_allclose(np.linalg.norm(vertices[:, 4:7], axis=1), 1, atol=1e-3)

    def test_states_are_restored_to_the_bit(self):
        simulation = sinew.Simulation(self.device, cube())
        simulation.step(10)
        state = simulation.save()
        simulation.step(10)
        later = simulation.positions.copy()
        simulation.load(state)
        simulation.step(10)
        np.testing.assert_array_equal(simulation.positions, later)
        simulation.reset()
        self.assertAlmostEqual(float(simulation.positions[:, 1].min()), 0.2, places=6)

    def test_grabs_and_fields_move_bodies(self):
        simulation = sinew.Simulation(self.device, cube(), sinew.Settings(grabs=1, fields=1))
        simulation.step(60)
        start = simulation.positions[:, :3].mean(axis=0)
        held = simulation.positions[26, :3].tolist()
        simulation.step(1, grabs=[sinew.Grab(26, held, radius=0.1)])
        held[1] += 0.5
        simulation.step(60, grabs=[sinew.Grab(26, held, radius=0.1)], fields=[sinew.Field("uniform", vector=(2, 0, 0))])
        end = simulation.positions[:, :3].mean(axis=0)
        self.assertGreater(end[1] - start[1], 0.2)
        self.assertGreater(end[0] - start[0], 0.01)
        simulation.step(1, grabs=[sinew.Grab(26, held)] * 3)
        self.assertIn("grabs", "".join(simulation.complaints()))

    def test_motions_throw_and_place_bodies(self):
        simulation = sinew.Simulation(self.device, cube(), sinew.Settings(motions=2))
        simulation.step(1, gravity=(0, 0, 0))
        start = simulation.positions[:, :3].mean(axis=0)
        pose = sinew.Motion("pose", 0, linear=(3, 1, 0), rotation=(0, 0, 0.5**0.5, 0.5**0.5))
        simulation.step(30, gravity=(0, 0, 0), motions=[pose, sinew.Motion("set_velocity", 0, linear=(0, 0, 2))])
        way = simulation.positions[:, :3].mean(axis=0) - start
        np.testing.assert_allclose(way, (3, 1, 1), atol=1e-4)  # once, whatever the number of steps
        with self.assertRaisesRegex(sinew.Error, "motion 0 is of a body that does not exist"):
            simulation.step(motions=[sinew.Motion("impulse", 7)])

    def test_a_blade_cuts_and_feels_toughness_times_width(self):
        scene = sinew.Scene()
        scene.add_lattice(cells=(8, 8, 8), spacing=0.02, young_modulus=1e4, cuttable=True, toughness=300)
        scene.gravity = (0, 0, 0)
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(substeps=2, keeps_forces=True))
        edge, total = np.array([[-0.1, 0.07, -1], [-0.1, 0.07, 1]]), np.zeros(3)
        for _ in range(20):
            after = edge + [0.02, 0, 0]
            simulation.step(blade=sinew.Blade(edge, after))
            edge, total = after, total + simulation.blade_impulse()
        self.assertEqual(simulation.status()["pieces"], 2)
        speed, area = 0.02 / scene.dt, 0.16**2
        np.testing.assert_allclose(total * speed / (300 * area), (-1, 0, 0), atol=0.1)
        simulation.step()
        np.testing.assert_array_equal(simulation.blade_impulse(), 0)
        with self.assertRaisesRegex(ValueError, "2 to 256 points"):
            sinew.Blade([[0, 0, 0]], [[0, 0, 0]])

    def test_bodies_come_and_go_by_motions(self):
        scene = cube()
        scene.set_absent(0)
        with self.assertRaisesRegex(sinew.Error, "settings.motions"):
            sinew.Simulation(self.device, scene)
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(motions=2))
        simulation.step(1, gravity=(0, 0, 0))
        self.assertTrue((simulation.positions[:, :3] == 1e6).all())
        there = sinew.Simulation(self.device, cube(), sinew.Settings(motions=2))
        there.step(1, gravity=(0, 0, 0))
        simulation.step(1, gravity=(0, 0, 0), motions=[sinew.Motion("spawn", 0, linear=(1, 0, 0))])
        np.testing.assert_allclose(simulation.positions[:, :3] - there.positions[:, :3], [(1, 0, 0)] * len(there.positions), atol=1e-6)
        simulation.step(1, gravity=(0, 0, 0), motions=[sinew.Motion("despawn", 0)])
        self.assertTrue((simulation.positions[:, :3] == 1e6).all())
        with self.assertRaisesRegex(sinew.Error, "does not let be absent"):
            there.step(motions=[sinew.Motion("spawn", 0)])

    def test_as_many_host_colliders_as_asked_for_push(self):
        scene = sinew.Scene()
        places = np.stack(np.meshgrid(np.arange(16), np.arange(16), [0]), axis=-1).reshape(-1, 3).astype(float)
        scene.add_particles(places)
        scene.gravity = (0, 0, 0)
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(substeps=4, host_colliders=256))
        for step in range(10):
            simulation.step(host_colliders=[
                sinew.HostCollider("capsule", place - (0.2 - 0.02 * step, 0, 0), radius=0.1, half_length=0.2) for place in places
            ])
        np.testing.assert_allclose(simulation.positions[:, 0], places[:, 0] + 0.08, atol=1e-4)
        self.assertEqual(simulation.complaints(), [])
        simulation.step(host_colliders=[sinew.HostCollider("sphere", (9, 9, 9), radius=0.1)] * 257)
        self.assertIn("257 host colliders", simulation.complaints()[0])

    def test_positions_before_the_newest_step_are_kept(self):
        simulation = sinew.Simulation(self.device, cube(), sinew.Settings(substeps=4, keeps_previous=True))
        simulation.step(3)
        before = simulation.positions.copy()
        simulation.step()
        np.testing.assert_array_equal(simulation.previous_positions, before)
        self.assertEqual(sinew.Simulation(self.device, cube()).previous_positions.size, 0)

    def test_impulses_carry_the_weight(self):
        scene = cube(height=0)
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(keeps_forces=True))
        simulation.step(240)
        force = simulation.impulses()[0, 1, 0] / scene.dt  # of the plane
        weight = 1000 * 0.2**3 * 9.81
        self.assertAlmostEqual(float(force[1]), weight, delta=0.02 * weight)

    def test_errors_are_sentences(self):
        scene = sinew.Scene()
        scene.add_particles([[0, 0, 0]])
        scene.add_links([[0, 5]], 1.0)
        with self.assertRaises(sinew.Error) as raised:
            scene.validate()
        self.assertEqual(raised.exception.result, "SINEW_ERROR_INVALID_SCENE")
        self.assertIn("distance[0]", str(raised.exception))
        with self.assertRaises(ValueError):
            scene.add_particles(np.zeros((4, 2)))
        with self.assertRaises(ValueError):
            scene.add_particles(np.zeros((4, 3)), inverse_masses=np.ones(3))
        with self.assertRaises(TypeError):
            scene.add_lattice(cell=(1, 1, 1))
        with self.assertRaises(TypeError):
            sinew.Settings(substep=3)
        with self.assertRaises(ValueError):
            sinew.Settings(solver="magic")
        with self.assertRaises(sinew.Error):
            sinew.Scene("no such file.toml")

    def test_meshes_become_bodies(self):
        scene = sinew.Scene()
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        self.assertEqual(scene.add_mesh(vertices, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], resolution=8), 0)
        self.assertGreater(scene.particle_count, 100)
        scene.validate()

    def test_texture_coordinates_go_through_a_cut(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]], float)
        faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        vertices = np.concatenate([corners[face] for face in faces])  # seams along all edges
        texture = np.array([[2 * k + u, v] for k in range(6) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
        triangles = np.concatenate([[[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]] for k in range(6)])
        scene = sinew.Scene()
        scene.gravity = (0, 0, 0)
        with self.assertRaisesRegex(ValueError, "a row for each vertex"):
            scene.add_mesh(vertices, triangles, texture[:5])
        scene.add_mesh(vertices, triangles, texture, resolution=5, cuttable=True)
        simulation = sinew.Simulation(self.device, scene, sinew.Settings(substeps=2))
        simulation.step(blade=sinew.Blade([(0.42, -1, -1), (0.44, -1, 2)], [(0.42, 2, -1), (0.44, 2, 2)]))
        simulation.update_skin()
        self.assertEqual(simulation.texture_coordinates.shape, (len(simulation.skin_indices), 2))
        first, count = simulation.cut_draws[1, [2, 0]]
        self.assertGreater(count, 0)
        pieces = simulation.cut_indices[first:first + count]
        at, places = simulation.cut_texture_coordinates[pieces], simulation.cut_rest[pieces, :3]
        island = np.repeat(np.floor((at.reshape(-1, 3, 2)[:, :, 0].mean(axis=1)) / 2).astype(int), 3)
        for k, face in enumerate(faces):  # linear on each face
            a, b, d = corners[face[0]], corners[face[1]], corners[face[3]]
            mine = island == k
            expected = np.stack([2 * k + (places[mine] - a) @ (b - a), (places[mine] - a) @ (d - a)], axis=1)
            np.testing.assert_allclose(at[mine], expected, atol=1e-5)

    def test_files_and_descriptions(self):
        scene = sinew.Scene(str(SCENES / "cube.toml"))
        self.assertGreater(scene.settings.substeps, 0)
        self.assertIn("gather_lattice", sinew.describe(scene))
        self.assertEqual(sinew.describe(SCENES / "cube.toml"), sinew.describe(scene))

    def test_the_program_gives_reports(self):
        report = sinew.run(SCENES / "cube.toml", frames=5, substeps=8)
        self.assertEqual(report["schema"], 1)
        with self.assertRaises(sinew.Error) as raised:
            sinew.run("no such file.toml")
        self.assertEqual(raised.exception.result, "exit code 3")

    def test_a_study_is_a_report(self):
        with tempfile.TemporaryDirectory() as folder:
            report = sinew.study("chain", out=folder, points=1, frames=2)
            self.assertTrue((pathlib.Path(folder) / "study.json").exists())
        self.assertIsInstance(report, dict)

    def test_levels_are_a_number_or_auto(self):
        settings = sinew.Settings(substeps=8, levels="auto")
        self.assertEqual(settings.levels, "auto")
        settings.levels = 2
        self.assertEqual(settings.levels, 2)
        with self.assertRaisesRegex(ValueError, 'levels is "many": must be a number from 0 to 6, or "auto"'):
            settings.levels = "many"

    def test_bodies_come_and_go_and_the_others_keep_their_bits(self):
        def box(x, cells=2):
            scene = sinew.Scene()
            scene.add_lattice(cells=(cells,) * 3, origin=(x, 0.2, 0), spacing=0.05, young_modulus=5e4)
            return scene

        base = sinew.Scene()
        base.add_plane(friction=0.5)
        settings = sinew.Settings(substeps=6)
        world, alone = (sinew.World(self.device, base, settings) for _ in range(2))
        first, kept = world.add(box(-1)), world.add(box(0))
        self.assertIsNone(world.find(kept))
        self.assertTrue(world.is_changing)
        with self.assertRaises(ValueError):
            world.positions(kept)
        world.step(20)
        self.assertEqual(world.find(kept)["particles"], (27, 27))
        world.remove(first)
        self.assertNotIn(first, world)
        other = world.add(box(1, 3))
        world.step(20)
        self.assertEqual(world.find(kept)["particles"], (0, 27))
        same = alone.add(box(0))
        alone.step(40)
        positions = world.positions(kept)
        self.assertLess(positions[0, 1], 0.19)
        np.testing.assert_array_equal(positions.view(np.uint32), alone.positions(same).view(np.uint32))
        np.testing.assert_array_equal(world.velocities(kept).view(np.uint32), alone.velocities(same).view(np.uint32))
        self.assertEqual(world.positions(other).shape, (64, 4))
        self.assertEqual(world.positions().shape, (27 + 64, 4))
        self.assertEqual((world.counts()["bodies"], world.steps_done, world.substeps, world.take_overs), (2, 40, 6, 2))
        self.assertEqual(len({kept: 1, other: 2}), 2)
        with self.assertRaises(sinew.Error) as raised:
            world.remove(first)
        self.assertEqual(raised.exception.result, "SINEW_ERROR_INVALID_HANDLE")
        with self.assertRaises(sinew.Error):
            world.find(first)
        with self.assertRaises(sinew.Error):
            alone.remove(kept)

    def test_rays_and_regions_find_particles_of_a_world(self):
        def box(x):
            scene = sinew.Scene()
            scene.add_lattice(cells=(2, 2, 2), origin=(x, 0, 0), spacing=0.1, young_modulus=1e5, skin=True)
            return scene

        base = sinew.Scene()
        base.gravity = (0, 0, 0)
        world = sinew.World(self.device, base)
        self.assertIsNone(world.pick((0.1, 3, 0.1), (0, -1, 0)))
        self.assertEqual(world.overlap((0, 0, 0), radius=9).size, 0)
        left = world.add(box(0))
        world.add(box(2))
        world.update()
        hit = world.pick((0.1, 3, 0.1), (0, -1, 0))
        self.assertAlmostEqual(hit["distance"], 2.8, places=5)
        np.testing.assert_allclose(hit["point"], (0.1, 0.2, 0.1), atol=1e-6)
        np.testing.assert_allclose(hit["place"], world.positions()[hit["particle"], :3])
        self.assertEqual(hit["body"], 0)
        self.assertEqual(world.pick((2.1, 3, 0.1), (0, -1, 0))["body"], 1)
        self.assertIsNone(world.pick((0.1, 3, 0.1), (0, -1, 0), length=2.7))
        self.assertIsNone(world.pick((1, 3, 0.1), (0, -1, 0)))
        positions = world.positions()[:, :3]
        inside = np.flatnonzero(np.linalg.norm(positions - (0.1, 0.1, 0.1), axis=1) < 0.11)
        found = world.overlap((0.1, 0.1, 0.1), radius=0.11)
        self.assertEqual(found.dtype, np.uint32)
        np.testing.assert_array_equal(found, inside)
        self.assertEqual(world.overlap((2.1, 0.1, 0.1), half_extents=(0.11, 0.11, 0.11)).size, 27)
        world.remove(left)
        world.update()
        self.assertEqual(world.pick((2.1, 3, 0.1), (0, -1, 0))["body"], 0)
        self.assertIsNone(world.pick((0.1, 3, 0.1), (0, -1, 0)))

    def test_events_say_what_happened(self):
        settings = sinew.Settings(events=["contact_begins", "contact_ends"])
        self.assertEqual(settings.events, ["contact_begins", "contact_ends"])
        with self.assertRaises(ValueError):
            settings.events = ["falls"]
        simulation = sinew.Simulation(self.device, cube(), settings)
        self.assertEqual(simulation.events(), [])
        simulation.step(16)
        (event,) = simulation.events()
        self.assertEqual({**event, "count": 0, "step": 12},
                         {"step": 12, "kind": "contact_begins", "body": 0, "partner": "plane", "other": 0, "count": 0})
        self.assertAlmostEqual(event["step"], 12, delta=1)
        world = sinew.World(self.device, cube(0.01), settings)
        world.step(5)
        self.assertEqual([event["kind"] for event in world.events()], ["contact_begins"])

    def test_stubs_name_all_that_there_is(self):
        stub = (pathlib.Path(sinew.__file__).parent / "__init__.pyi").read_text(encoding="utf-8")
        for name in sinew.__all__:
            self.assertRegex(stub, rf"(class|def) {name}\b")
            for member in dir(getattr(sinew, name)) if isinstance(getattr(sinew, name), type) and name != "Error" else []:
                if not member.startswith("_") and "pybind11" not in member:
                    self.assertRegex(stub, rf"\b{member}\b", f"{name}.{member}")


if __name__ == "__main__":
    unittest.main()
