// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// lightstripe._core, the C++ half of the Python package `lightstripe`. Thin on purpose: what a function does
// stands at the function of the same name in the library.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argument_words.h"
#include "arrays.h"
#include "core/counted.h"
#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "jobs.h"
#include "options.h"
#include "reconstruct/cloud.h"
#include "reconstruct/triangulate.h"

namespace lightstripe::python {
namespace {

namespace fs = std::filesystem;

ExtractionResult extract(const py::array& image, const py::kwargs& given) {
  ExtractionOptions options;
  apply_options(options, given);
  const auto run = [&options](auto view) {
    const py::gil_scoped_release others_may_run;
    return extract_stripes(view, options);
  };
  if (image.dtype().is(py::dtype::of<std::uint8_t>())) return run(image_view<std::uint8_t>(image));
  if (image.dtype().is(py::dtype::of<std::uint16_t>())) return run(image_view<std::uint16_t>(image));
  throw py::value_error("expected pixels of the dtype uint8 or uint16");
}

ExtractionResult extraction_of(const std::vector<py::array>& stripes) {
  ExtractionResult result;
  for (const auto& records : stripes) result.stripes.push_back({stripe_points(records)});
  return result;
}

/// One extraction a sensor of the rig, in its order; None where a sensor has no picture in this frame.
Profile triangulate(const std::vector<const ExtractionResult*>& extractions, const Rig& rig, double travel,
                    std::int64_t frame) {
  if (extractions.size() != rig.sensors.size())
    throw py::value_error("the rig has " + std::to_string(rig.sensors.size()) +
                          " sensors: give as many extractions (or None)");
  Profile profile;
  profile.frame = frame;
  profile.travel = travel;
  for (std::size_t i = 0; i < extractions.size(); ++i)
    if (extractions[i] != nullptr)
      triangulate_stripes(extractions[i]->stripes, rig, static_cast<int>(i), {travel, {}}, profile);
  return profile;
}

void write_profiles(const fs::path& path, const py::iterable& profiles) {
  std::string text(kProfilesHeader);
  for (const py::handle profile : profiles) {
    if (!py::isinstance<Profile>(profile))
      throw py::type_error("write_profiles takes Profile objects, not " +
                           py::repr(py::type::of(profile)).cast<std::string>());
    append_profile(text, profile.cast<const Profile&>());
  }
  write_file(path, text);
}

/// The motion as a dict with the keys of rig.yaml; None for a rig without one.
std::optional<py::dict> motion_of(const Rig& rig) {
  using py::literals::operator""_a;
  const Motion& motion = rig.motion;
  const char* const moves = motion.moves == Moves::kRig ? "rig" : "object";
  switch (motion.type) {
    case MotionType::kNone:
      return std::nullopt;
    case MotionType::kLinear:
      return py::dict("type"_a = "linear", "direction"_a = motion.direction, "moves"_a = moves);
    case MotionType::kRotary:
      break;
  }
  return py::dict("type"_a = "rotary", "axis_point"_a = motion.axis_point,
                  "axis_direction"_a = motion.axis_direction, "moves"_a = moves);
}

/// What the calibration says of itself; a value that is not known is None.
py::dict quality_of(const Rig& rig) {
  using py::literals::operator""_a;
  const RigQuality& quality = rig.quality;
  const auto known = [](double value) { return value > 0 ? py::object(py::float_(value)) : py::none(); };
  return py::dict("section_shape_sigma_mm"_a = known(quality.section_shape_sigma_mm),
                  "section_absolute_sigma_mm"_a = known(quality.section_absolute_sigma_mm),
                  "cross_validation_ratio"_a = known(quality.cross_validation_ratio.value_or(0)),
                  "weakest"_a = quality.weakest, "warnings"_a = quality.warnings, "sigma"_a = quality.sigma);
}

Channel channel_of(const std::string& name) {
  for (const auto& entry : enum_names(Channel{}))
    if (entry.name == name) return entry.value;
  throw py::value_error("'" + name +
                        "' is no channel: use auto, gray, or red, green or blue, alone or with -excess, "
                        "-laser, -clipped or -textured");
}

Eigen::Matrix3d camera_matrix(const Camera& camera) {
  return (Eigen::Matrix3d() << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1).finished();
}

Eigen::Matrix4d matrix_of(const Rigid3& transform) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = transform.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = transform.translation;
  return matrix;
}

void add_rig(py::module_& module) {
  py::class_<Sensor>(module, "Sensor", "One camera with the laser planes that it sees.")
      .def_readonly("name", &Sensor::name)
      .def_property_readonly("image_size",
                             [](const Sensor& s) { return py::make_tuple(s.camera.width, s.camera.height); })
      .def_property_readonly(
          "camera_matrix", [](const Sensor& s) { return camera_matrix(s.camera); }, "3 x 3, px")
      .def_property_readonly(
          "distortion", [](const Sensor& s) { return s.camera.distortion; }, "14 terms in OpenCV's order")
      .def_property_readonly(
          "laser_planes",
          [](const Sensor& s) {
            py::list planes;
            for (const Plane& plane : s.laser_planes)
              planes.append(py::make_tuple(plane.normal, plane.offset));
            return planes;
          },
          "list of (normal, offset in mm): normal . p = offset in the camera frame")
      .def_property_readonly(
          "rig_from_camera", [](const Sensor& s) { return matrix_of(s.rig_from_camera); }, "4 x 4, mm")
      .def("__repr__", [](const Sensor& s) {
        return fmt::format("<lightstripe.Sensor '{}', {} x {} px, {}>", s.name, s.camera.width,
                           s.camera.height, counted(s.laser_planes.size(), "laser plane"));
      });
  py::class_<Rig>(module, "Rig", "A calibrated rig, as rig.yaml holds it.")
      .def_readonly("sensors", &Rig::sensors)
      .def_property_readonly("motion", &motion_of, "dict with the keys of rig.yaml, or None")
      .def_property_readonly("quality", &quality_of,
                             "dict: predicted errors in mm (None where not known), warnings, sigma of every "
                             "parameter by name")
      .def("to_yaml", &rig_to_yaml, "the text of rig.yaml")
      .def("__repr__", [](const Rig& rig) {
        std::string names;
        for (const Sensor& sensor : rig.sensors) names += (names.empty() ? "" : ", ") + sensor.name;
        const bool moves = rig.motion.type != MotionType::kNone;
        return fmt::format("<lightstripe.Rig of {}, {} motion>", names,
                           moves ? enum_name(rig.motion.type) : "no");
      });
  module.def(
      "read_rig", [](const fs::path& path) { return read_rig(path); }, py::arg("path"), "rig.yaml to a Rig");
}

void add_extraction(py::module_& module) {
  py::class_<ExtractionResult>(module, "Extraction", "The stripes of one picture.")
      .def(py::init(&extraction_of), py::arg("stripes"), "from record arrays of one's own, which are copied")
      .def_property_readonly(
          "stripes",
          [](const py::object& self) {
            py::list stripes;
            for (const Stripe& stripe : self.cast<const ExtractionResult&>().stripes)
              stripes.append(view_of(stripe.points, self));
            return stripes;
          },
          "list of record arrays, longest stripe first; they look at the extraction's own memory")
      .def_readonly("sigma", &ExtractionResult::sigma, "scale of the kernels, px")
      .def_readonly("threshold_low", &ExtractionResult::threshold_low)
      .def_readonly("threshold_high", &ExtractionResult::threshold_high)
      .def_readonly("noise", &ExtractionResult::noise, "grey levels, 1 sigma")
      .def("__repr__", [](const ExtractionResult& result) {
        std::size_t points = 0;
        for (const Stripe& stripe : result.stripes) points += stripe.points.size();
        return fmt::format("<lightstripe.Extraction of {}, {}, sigma {:.2f} px>",
                           counted(result.stripes.size(), "stripe"), counted(points, "point"), result.sigma);
      });
  py::enum_<StripeFlag>(module, "StripeFlag", py::arithmetic(), "Bits of a stripe point's `flags`.")
      .value("BRIDGED", kStripeBridged, "placed across a gap or a crossing")
      .value("SATURATED", kStripeSaturated, "the stripe's top is clipped")
      .value("ASYMMETRIC", kStripeAsymmetric, "the two flanks differ");
  module.def("extract", &extract, py::arg("image"),
             "Centre lines of the light stripes of a grey picture (uint8 or uint16, rows x columns; not "
             "copied). Keywords are the "
             "options of the extraction: stripe_width=6, method=\"steger\", roi=(0, 0, 100, 100), "
             "thresholds=(20, 60), lines={\"min_length\": 20}.");
  module.def(
      "read_image",
      [](const fs::path& path, const std::string& channel) {
        return adopted(read_image(path, channel_of(channel)));
      },
      py::arg("path"), py::arg("channel") = "auto", "A picture file to grey values, uint8.");
}

void add_profiles(py::module_& module) {
  py::class_<Profile>(module, "Profile", "All points of one frame.")
      .def(py::init([](const py::array& points, double travel, std::int64_t frame) {
             Profile profile;
             profile.frame = frame;
             profile.travel = travel;
             profile.points = profile_points(points);
             return profile;
           }),
           py::arg("points"), py::arg("travel") = 0.0, py::arg("frame") = 0,
           "from a record array, which is copied")
      .def_readonly("frame", &Profile::frame)
      .def_readonly("travel", &Profile::travel, "mm or degrees")
      .def_readonly("num_missed", &Profile::num_missed, "stripe points that gave no point")
      .def_property_readonly(
          "points", [](const py::object& self) { return view_of(self.cast<const Profile&>().points, self); },
          "record array (x, y, z, u, v, sigma in mm ...) that looks at the profile's own memory")
      .def("__repr__", [](const Profile& profile) {
        return fmt::format("<lightstripe.Profile of frame {}, travel {}, {}>", profile.frame, profile.travel,
                           counted(profile.points.size(), "point"));
      });
  module.def("triangulate", &triangulate, py::arg("extractions"), py::arg("rig"), py::arg("travel") = 0.0,
             py::arg("frame") = 0,
             "One frame's points: a list with the extraction of each sensor of the rig, None where one has "
             "no picture.");
  module.def("read_profiles", &read_profiles, py::arg("path"), "profiles.csv to a list of profiles");
  module.def("write_profiles", &write_profiles, py::arg("path"), py::arg("profiles"),
             "profiles.csv, written aside and renamed");
  module.def(
      "read_cloud", [](const fs::path& path) { return adopted(read_cloud(path)); }, py::arg("path"),
      "A .ply or .pcd cloud of `reconstruct` to a record array (x, y, z in mm, intensity, frame, sensor, "
      "line, sigma in mm).");
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() =
      "Line-structured-light 3D scanning: extract laser stripes, triangulate them with a calibrated rig.";
  module.attr("__version__") = LIGHTSTRIPE_VERSION;
  static const py::exception<Error> error_type(module, "Error", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      PyErr_SetString(error_type.ptr(), in_arguments(error.what()).c_str());
    }
  });
  add_rig(module);
  add_extraction(module);
  add_profiles(module);
  add_jobs(module);
}

}  // namespace lightstripe::python
