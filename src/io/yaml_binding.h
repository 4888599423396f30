// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Strict YAML for structs that list their fields (core/fields.h): unknown, repeated and ill-typed keys are errors that
// name file, key and line. yaml-cpp stays inside this folder.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/fields.h"

namespace lightstripe {

/// A part of a YAML file kept as it stands, to be bound later by whoever knows its fields
/// (the extraction options of a scan). Empty = not given.
struct YamlSubtree {
  std::string text;    ///< YAML text of the part
  std::string origin;  ///< "scan.yaml: extraction", for messages
};

namespace detail {
class YamlNode;  // yaml-cpp's node, hidden
}

// (implementation: the io owner completes this header: read_yaml, read_subtree, dump_yaml)

}  // namespace lightstripe
