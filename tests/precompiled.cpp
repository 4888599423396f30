// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Nothing of its own: the tests share the precompiled headers that belong to this file (see
// LightstripeTargets.cmake).
