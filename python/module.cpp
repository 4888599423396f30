// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The Python module `lightstripe`: extract, load a rig, triangulate, read and write profiles. Thin on
// purpose: what a function does stands at the function of the same name in the library.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include "arrays.h"
#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/rig_file.h"
#include "io/tables.h"
#include "options.h"
#include "reconstruct/triangulate.h"

namespace lightstripe::python {
namespace {

namespace fs = std::filesystem;

ExtractionResult extract(const py::array& image, const py::kwargs& given) {
  const ExtractionOptions options = extraction_options(given);
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

void write_profiles(const fs::path& path, const std::vector<const Profile*>& profiles) {
  std::string text(kProfilesHeader);
  for (const Profile* profile : profiles) append_profile(text, *profile);
  write_file(path, text);
}

Channel channel_of(const std::string& name) {
  for (const auto& entry : enum_names(Channel{}))
    if (entry.name == name) return entry.value;
  throw py::value_error(
      "'" + name +
      "' is no channel: use auto, gray, or red, green or blue, alone or with -excess, -laser or -clipped");
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
          "rig_from_camera", [](const Sensor& s) { return matrix_of(s.rig_from_camera); }, "4 x 4, mm");
  py::class_<Rig>(module, "Rig", "A calibrated rig, as rig.yaml holds it.")
      .def_readonly("sensors", &Rig::sensors)
      .def("to_yaml", &rig_to_yaml, "the text of rig.yaml");
  module.def("read_rig", &read_rig, py::arg("path"));
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
      .def_readonly("noise", &ExtractionResult::noise, "grey levels, 1 sigma");
  module.def("extract", &extract, py::arg("image"),
             "Centre lines of the light stripes of a grey picture (uint8 or uint16, rows x columns; not "
             "copied). Keywords are the "
             "options of the extraction: stripe_width=6, method=\"steger\", lines={\"min_length\": 20}.");
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
          "record array (x, y, z, u, v, sigma in mm ...) that looks at the profile's own memory");
  module.def("triangulate", &triangulate, py::arg("extractions"), py::arg("rig"), py::arg("travel") = 0.0,
             py::arg("frame") = 0,
             "One frame's points: a list with the extraction of each sensor of the rig, None where one has "
             "no picture.");
  module.def("read_profiles", &read_profiles, py::arg("path"), "profiles.csv to a list of profiles");
  module.def("write_profiles", &write_profiles, py::arg("path"), py::arg("profiles"),
             "profiles.csv, written aside and renamed");
}

}  // namespace

PYBIND11_MODULE(lightstripe, module) {
  module.doc() =
      "Line-structured-light 3D scanning: extract laser stripes, triangulate them with a calibrated rig.";
  module.attr("__version__") = LIGHTSTRIPE_VERSION;
  py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  add_rig(module);
  add_extraction(module);
  add_profiles(module);
}

}  // namespace lightstripe::python
