# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
"""Line-structured-light 3D scanning: extract laser stripes, triangulate them with a calibrated rig, run whole jobs.

The work is done in C++ (lightstripe._core); pictures are looked at where they are, points come as record arrays.
"""
from lightstripe import _core
from lightstripe._core import *  # noqa: F401,F403

__version__ = _core.__version__
__all__ = [name for name in dir(_core) if not name.startswith("_")]
