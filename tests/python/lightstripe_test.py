# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
"""The Python module gives what the command line gives, and looks at memory instead of copying it."""
import csv
import gc
import os
import pathlib
import re
import subprocess
import threading

import numpy as np
import pytest

import lightstripe

SOURCE = pathlib.Path(os.environ["LIGHTSTRIPE_SOURCE_DIR"])


def run(*arguments):
    subprocess.run([os.environ["LIGHTSTRIPE_BINARY"], *map(str, arguments)], check=True, capture_output=True)


@pytest.fixture(scope="module")
def scan(tmp_path_factory):
    """A small rendered scan with its true rig, and what the command line makes of it."""
    folder = tmp_path_factory.mktemp("scan with blanks")
    run("simulate", SOURCE / "testdata/one_sensor.yaml", "-o", folder)
    run("reconstruct", folder / "scan.yaml", "--rig", folder / "truth/rig.yaml", "-o", folder / "cloud.ply", "--profiles",
        folder / "profiles.csv")
    return folder


def stripe_image(dtype=np.uint8, row=60.25):
    rows = np.arange(120)[:, None]
    image = 20 + 180 * np.exp(-((rows - row) ** 2) / 6.0) + np.zeros((1, 160))
    return image.astype(dtype) if dtype == np.uint8 else (image * 200).astype(dtype)


def test_version_is_that_of_the_program():
    out = subprocess.run([os.environ["LIGHTSTRIPE_BINARY"], "--version"], capture_output=True, text=True, check=True).stdout
    assert lightstripe.__version__ == out.strip()


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
@pytest.mark.parametrize("method", ["direction-guided", "steger"])
def test_extract_finds_the_drawn_line(dtype, method):
    extraction = lightstripe.extract(stripe_image(dtype), stripe_width=6, method=method)
    assert len(extraction.stripes) == 1
    points = extraction.stripes[0]
    assert len(points) > 140
    # A noise-free straight line: what is left is the rounding to whole grey levels.
    assert np.abs(points["y"] - 60.25).max() < 0.02
    assert np.allclose(np.abs(points["normal_y"]), 1, atol=1e-3)


def test_a_crop_is_not_copied_and_gives_the_same_line():
    image = stripe_image()
    crop = image[20:100, 30:130]
    assert not crop.flags["C_CONTIGUOUS"]
    points = lightstripe.extract(crop, stripe_width=6).stripes[0]
    assert np.abs(points["y"] - 40.25).max() < 0.02


def test_stripes_look_at_the_extractions_memory_and_keep_it_alive():
    extraction = lightstripe.extract(stripe_image(), stripe_width=6)
    first, second = extraction.stripes[0], extraction.stripes[0]
    assert first.__array_interface__["data"] == second.__array_interface__["data"]
    assert first.base is extraction
    before = first.copy()
    del extraction, second
    gc.collect()
    assert np.array_equal(first, before)


@pytest.mark.parametrize("image", [np.zeros((4, 5, 3), np.uint8), np.zeros((4, 5), np.float64), np.zeros((40, 50), np.uint8)[:, ::2],
                                   np.zeros((40, 50), np.uint8)[::-1], np.broadcast_to(np.uint8(1), (9, 9))])
def test_extract_refuses_other_arrays(image):
    with pytest.raises(ValueError):
        lightstripe.extract(image)


def test_an_unknown_option_is_named():
    with pytest.raises(lightstripe.Error, match="strip_width"):
        lightstripe.extract(stripe_image(), strip_width=6)
    with pytest.raises(lightstripe.Error, match="lines.min_lenght"):
        lightstripe.extract(stripe_image(), lines={"min_lenght": 3})


def test_a_wrong_option_is_named_once():
    with pytest.raises(lightstripe.Error) as caught:
        lightstripe.extract(stripe_image(), strip_width=6)
    assert str(caught.value).count("strip_width") == 1


def test_options_are_python_values():
    picture = stripe_image()
    as_text = lightstripe.extract(picture, roi="0,20,100,80", thresholds="40,90", smoothing="true").stripes[0]
    as_values = lightstripe.extract(picture, roi=(0, 20, 100, 80), thresholds=[40, 90], smoothing=True).stripes[0]
    assert np.array_equal(as_text, as_values)
    assert as_values["x"].max() < 100
    assert len(lightstripe.extract(picture, stripe_width=None, sigma=2).stripes) == 1
    with pytest.raises(TypeError, match="roi"):
        lightstripe.extract(picture, roi=(0, None, 1, 1))


def test_flags_of_points_are_named():
    clipped = np.minimum(stripe_image().astype(int) * 3, 255).astype(np.uint8)
    points = lightstripe.extract(clipped, stripe_width=8).stripes[0]
    assert (points["flags"] & lightstripe.StripeFlag.SATURATED).any()


def test_none_where_an_object_belongs_is_a_type_error(tmp_path):
    with pytest.raises(TypeError):
        lightstripe.write_profiles(tmp_path / "profiles.csv", [None])
    with pytest.raises(TypeError):
        lightstripe.Extraction([None])
    assert not (tmp_path / "profiles.csv").exists()


def test_objects_describe_themselves(scan):
    rig = lightstripe.read_rig(scan / "truth/rig.yaml")
    assert repr(rig) == "<lightstripe.Rig of solo, linear motion>"
    assert repr(rig.sensors[0]) == "<lightstripe.Sensor 'solo', 480 x 350 px, 1 laser plane>"
    assert "1 stripe," in repr(lightstripe.extract(stripe_image()))
    assert "frame 0" in repr(lightstripe.read_profiles(scan / "profiles.csv")[0])


def test_motion_and_quality_are_those_of_the_file(scan):
    rig = lightstripe.read_rig(scan / "truth/rig.yaml")
    assert rig.motion["type"] == "linear" and rig.motion["moves"] == "rig"
    assert np.array_equal(rig.motion["direction"], [1, 0, 0])
    assert rig.quality["section_shape_sigma_mm"] is None  # a true rig has no predicted error


def test_a_cloud_is_a_record_array(scan):
    cloud = lightstripe.read_cloud(scan / "cloud.ply")
    points = np.concatenate([profile.points for profile in lightstripe.read_profiles(scan / "profiles.csv")])
    assert len(cloud) == len(points)
    assert np.allclose(cloud["z"], points["z"], atol=1e-3)
    assert cloud["frame"].max() == 5


def test_an_empty_picture_gives_no_stripe():
    assert lightstripe.extract(np.zeros((0, 0), np.uint8)).stripes == []


def test_threads_extract_at_the_same_time():
    results = [None] * 4

    def work(index):
        results[index] = lightstripe.extract(stripe_image(), stripe_width=6).stripes[0].copy()

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(results[0], other) for other in results)


def test_rig_is_that_of_the_file(scan):
    rig = lightstripe.read_rig(scan / "truth/rig.yaml")
    sensor = rig.sensors[0]
    assert sensor.name == "solo" and sensor.image_size == (480, 350)
    assert sensor.camera_matrix[0, 0] == pytest.approx(821)
    normal, offset = sensor.laser_planes[0]
    assert np.linalg.norm(normal) == pytest.approx(1) and offset > 0
    assert np.allclose(sensor.rig_from_camera[:3, :3] @ sensor.rig_from_camera[:3, :3].T, np.eye(3))
    assert rig.to_yaml() == (scan / "truth/rig.yaml").read_text()


def test_reconstruction_equals_that_of_the_command_line(scan):
    rig = lightstripe.read_rig(scan / "truth/rig.yaml")
    with open(scan / "scan/travel.csv", newline="") as table:
        travel = [float(row["travel_mm"]) for row in csv.DictReader(table)]
    profiles = []
    for frame, file in enumerate(sorted((scan / "scan/solo").glob("*.png"))):
        extraction = lightstripe.extract(lightstripe.read_image(file))
        profiles.append(lightstripe.triangulate([extraction], rig, travel=travel[frame], frame=frame))
    lightstripe.write_profiles(scan / "python.csv", profiles)
    assert (scan / "python.csv").read_bytes() == (scan / "profiles.csv").read_bytes()


def test_profiles_are_read_back(scan):
    profiles = lightstripe.read_profiles(scan / "profiles.csv")
    assert [profile.frame for profile in profiles] == list(range(6))
    table = np.genfromtxt(scan / "profiles.csv", delimiter=",", names=True)
    points = np.concatenate([profile.points for profile in profiles])
    for column in ("x", "y", "z", "u", "v", "sigma"):
        assert np.array_equal(points[column], table[column])
    assert profiles[0].points.base is profiles[0]


def test_own_stripes_and_profiles_can_be_handed_over(scan):
    rig = lightstripe.read_rig(scan / "truth/rig.yaml")
    points = lightstripe.extract(lightstripe.read_image(scan / "scan/solo/0003.png")).stripes[0]
    half = points[: len(points) // 2]
    profile = lightstripe.triangulate([lightstripe.Extraction([half])], rig)
    assert len(profile.points) + profile.num_missed == len(half)
    again = lightstripe.Profile(profile.points[::2], travel=3.0, frame=7)
    assert again.frame == 7 and np.array_equal(again.points, profile.points[::2])
    with pytest.raises(ValueError):
        lightstripe.Extraction([np.zeros(3)])
    with pytest.raises(ValueError):
        lightstripe.triangulate([], rig)


def test_a_missing_file_is_an_error_with_its_name(tmp_path):
    for read in (lightstripe.read_rig, lightstripe.read_profiles, lightstripe.read_image):
        with pytest.raises(lightstripe.Error, match="nothing-here"):
            read(tmp_path / "nothing-here")


def test_the_page_about_the_library_runs_as_it_stands(scan, tmp_path, monkeypatch):
    page = (SOURCE / "docs/how-to/use_as_a_library.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", page, re.S)
    assert blocks
    (tmp_path / "rig.yaml").write_bytes((scan / "truth/rig.yaml").read_bytes())
    (tmp_path / "frame.png").write_bytes((scan / "scan/solo/0002.png").read_bytes())
    monkeypatch.chdir(tmp_path)
    for block in blocks:
        exec(compile(block, "use_as_a_library.md", "exec"), {})
    assert lightstripe.read_profiles("profiles.csv")[0].points.size > 100


@pytest.mark.parametrize("true_width", [4, 6, 10])
def test_a_width_up_to_twice_the_true_one_costs_little_and_sigma_tells_what_half_of_it_costs(true_width):
    # A bar with soft edges and the noise of a good camera; 0.005 px is what that noise leaves at the true width.
    rows, columns = np.mgrid[0:200, 0:300]
    across = rows - (100.3 + 0.04 * columns)
    bar = (np.tanh((across + true_width / 2) / 0.7) - np.tanh((across - true_width / 2) / 0.7)) / 2
    noise = np.random.default_rng(1).normal(0, 1.5, bar.shape)
    image = np.clip(20 + 170 * bar + noise, 0, 255).astype(np.uint8)
    for share in (1, 1.5, 2):
        (points,) = lightstripe.extract(image, stripe_width=share * true_width).stripes
        points = points[(points["x"] > 10) & (points["x"] < 290)]
        assert np.std(points["y"] - 0.04 * points["x"]) < 0.015, share
    for share in (0.3, 0.5):  # too fine for the bar: at a third of its width most are not found
        stripes = lightstripe.extract(image, stripe_width=share * true_width).stripes
        assert len(stripes) == 1 or (share < 0.5 and not stripes), share
        for points in stripes:
            errors = points["y"] - 100.3 - 0.04 * points["x"]
            assert np.sqrt(np.mean(errors**2)) < 1.5 * np.sqrt(np.mean(points["sigma_px"] ** 2)), share


def test_the_jobs_give_what_the_commands_write(scan, tmp_path):
    rig_file = scan / "truth/rig.yaml"
    made = lightstripe.reconstruct(scan / "scan.yaml", tmp_path / "cloud.ply", rig=rig_file, profiles=tmp_path / "profiles.csv")
    assert made.usable and made.num_frames == 6
    assert (tmp_path / "cloud.ply").read_bytes() == (scan / "cloud.ply").read_bytes()
    assert (tmp_path / "profiles.csv").read_bytes() == (scan / "profiles.csv").read_bytes()
    assert len(made.cloud) == made.num_points and made.profiles == []

    kept = lightstripe.reconstruct(scan / "scan.yaml", rig=rig_file)
    assert [profile.frame for profile in kept.profiles] == list(range(6))
    assert sum(len(profile.points) for profile in kept.profiles) == made.num_points
    assert kept.cloud is None

    calibration = lightstripe.calibrate(scan / "calibration.yaml", tmp_path / "rig.yaml", extraction={"stripe_width": 6})
    assert calibration.num_images == len(calibration.views) + len([r for r in calibration.rejected if "board" in r["reason"]])
    assert calibration.usable == (tmp_path / "rig.yaml").exists()
    assert calibration.usable or calibration.reason
    if calibration.usable:
        assert calibration.rig.to_yaml() == (tmp_path / "rig.yaml").read_text()


def test_measure_gives_the_rows_of_the_table(scan, tmp_path):
    found = lightstripe.measure(scan / "profiles.csv", "rail", tmp_path / "measurements.csv")
    with open(tmp_path / "measurements.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert [str(row["frame"]) for row in found.rows] == [row["frame"] for row in rows]
    for ours, theirs in zip(found.rows, rows):
        assert ours["status"] == theirs["status"]
        assert (ours["vertical_wear"] is None) == (theirs["vertical_wear"] == "")
    assert found.usable or found.reason
    with pytest.raises(ValueError, match="tram"):
        lightstripe.measure(scan / "profiles.csv", "tram")
    with pytest.raises(lightstripe.Error, match="iterationz"):
        lightstripe.measure(scan / "profiles.csv", "rail", options={"registration": {"iterationz": 3}})


def test_errors_speak_of_arguments_not_of_command_lines(scan, tmp_path):
    with pytest.raises(lightstripe.Error) as caught:
        lightstripe.measure(scan / "profiles.csv", "wheel", nominal="auto")
    assert str(caught.value).startswith('`nominal="auto"`: tells rails apart, not wheels')
    with pytest.raises(lightstripe.Error) as caught:
        lightstripe.measure(scan / "profiles.csv", "wheel", nominal="60E1")
    assert "--" not in str(caught.value)
    assert "`kind`" in str(caught.value)


def test_the_stubs_name_what_the_module_has():
    stubs = (pathlib.Path(lightstripe.__file__).parent / "__init__.pyi").read_text()
    declared = set(re.findall(r"^(?:def|class) (\w+)", stubs, re.M))
    assert declared == set(lightstripe.__all__)
    for name in declared:
        thing = getattr(lightstripe, name)
        if not isinstance(thing, type) or issubclass(thing, Exception):
            continue
        body = re.search(rf"^class {name}\b.*?(?=^\S|\Z)", stubs, re.M | re.S).group(0)
        members = {m for m in vars(thing) if not m.startswith("_")} - {"name", "value"}
        missing = {m for m in members if not re.search(rf"\b{m}\b", body)}
        assert not missing - {"name", "value"}, (name, missing)
