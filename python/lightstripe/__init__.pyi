# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
# Types of the package for editors and type checkers; a test compares the names with the module's.
import enum
from os import PathLike
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str
__all__: List[str]

_Path = Union[str, PathLike[str]]
_Options = Dict[str, Any]

class Error(RuntimeError): ...

class StripeFlag(enum.IntEnum):
    BRIDGED: int
    SATURATED: int
    ASYMMETRIC: int

class Sensor:
    name: str
    image_size: Tuple[int, int]
    camera_matrix: npt.NDArray[np.float64]
    distortion: npt.NDArray[np.float64]
    laser_planes: List[Tuple[npt.NDArray[np.float64], float]]
    rig_from_camera: npt.NDArray[np.float64]

class Rig:
    sensors: List[Sensor]
    motion: Optional[Dict[str, Any]]
    quality: Dict[str, Any]
    def to_yaml(self) -> str: ...

class Extraction:
    stripes: List[npt.NDArray[np.void]]
    sigma: float
    threshold_low: float
    threshold_high: float
    noise: float
    def __init__(self, stripes: Sequence[npt.NDArray[np.void]]) -> None: ...

class Profile:
    frame: int
    travel: float
    num_missed: int
    points: npt.NDArray[np.void]
    def __init__(self, points: npt.NDArray[np.void], travel: float = 0.0, frame: int = 0) -> None: ...

class Calibration:
    usable: bool
    reason: str
    rig: Rig
    warnings: List[str]
    num_images: int
    num_boards: int
    rejected: List[Dict[str, str]]
    views: List[Dict[str, Any]]

class Reconstruction:
    usable: bool
    reason: str
    num_frames: int
    num_points: int
    num_pictures_skipped: int
    profiles: List[Profile]
    cloud: Optional[npt.NDArray[np.void]]

class Measurements:
    usable: bool
    reason: str
    num_ok: int
    warnings: List[str]
    rows: List[Dict[str, Any]]

def extract(image: Union[npt.NDArray[np.uint8], npt.NDArray[np.uint16]], **options: Any) -> Extraction: ...
def read_image(path: _Path, channel: str = "auto") -> npt.NDArray[np.uint8]: ...
def read_rig(path: _Path) -> Rig: ...
def read_profiles(path: _Path) -> List[Profile]: ...
def write_profiles(path: _Path, profiles: Sequence[Profile]) -> None: ...
def read_cloud(path: _Path) -> npt.NDArray[np.void]: ...
def triangulate(
    extractions: Sequence[Optional[Extraction]], rig: Rig, travel: float = 0.0, frame: int = 0
) -> Profile: ...
def calibrate(
    session: _Path,
    output: Optional[_Path] = None,
    *,
    extraction: _Options = ...,
    calibration: _Options = ...,
    cameras: Optional[_Path] = None,
    threads: int = 0,
) -> Calibration: ...
def reconstruct(
    scan: _Path,
    output: Optional[_Path] = None,
    *,
    rig: Optional[_Path] = None,
    profiles: Optional[_Path] = None,
    extraction: _Options = ...,
    first_frame: Optional[int] = None,
    end_frame: Optional[int] = None,
    strict: bool = False,
    resume: bool = False,
    threads: int = 0,
) -> Reconstruction: ...
def measure(
    profiles: _Path,
    kind: str,
    output: Optional[_Path] = None,
    *,
    nominal: str = "",
    options: _Options = ...,
    limits: _Options = ...,
    rig: Optional[_Path] = None,
    threads: int = 0,
) -> Measurements: ...
