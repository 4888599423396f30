// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "jobs.h"

#include <fmt/format.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "argument_words.h"
#include "arrays.h"
#include "core/counted.h"
#include "core/error.h"
#include "options.h"
#include "pipeline/calibrate_job.h"
#include "pipeline/measure_job.h"
#include "pipeline/reconstruct_job.h"
#include "reconstruct/cloud.h"

namespace lightstripe::python {
namespace {

namespace fs = std::filesystem;
using py::literals::operator""_a;

/// Runs work(stop) on a thread of its own while this one looks for Ctrl-C, which Python can see on its main
/// thread only. Other Python threads may run meanwhile.
template <class Work>
auto run_interruptibly(const Work& work) {
  std::stop_source stop;
  auto result = std::async(std::launch::async, [&] { return work(stop.get_token()); });
  std::optional<py::error_already_set> interrupt;
  for (;;) {
    {
      const py::gil_scoped_release others_may_run;
      if (result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready) break;
    }
    if (!interrupt && PyErr_CheckSignals() != 0) {
      interrupt.emplace();
      stop.request_stop();
    }
  }
  if (interrupt) throw *interrupt;
  return result.get();
}

std::shared_ptr<CalibrateResult> run_calibrate(const fs::path& session, const std::optional<fs::path>& output,
                                               const py::dict& extraction, const py::dict& calibration,
                                               const std::optional<fs::path>& cameras, int threads) {
  CalibrateJob job = read_calibrate_job(session);
  apply_options(job.extraction, extraction, "extraction");
  apply_options(job.calibration, calibration, "calibration");
  job.rig = output.value_or(fs::path());
  job.camera_folder = cameras.value_or(fs::path());
  job.threads = threads;
  return std::make_shared<CalibrateResult>(
      run_interruptibly([&](const std::stop_token& stop) { return calibrate(job, {}, stop); }));
}

py::list rejected_of(const CalibrateResult& result) {
  py::list rejected;
  for (const RejectedImage& image : result.seen.rejected)
    rejected.append(py::dict("sensor"_a = image.sensor, "image"_a = image.image, "reason"_a = image.reason));
  return rejected;
}

py::list views_of(const CalibrateResult& result) {
  py::list views;
  for (const ViewResidual& view : result.calibration.summary.views)
    views.append(py::dict("sensor"_a = view.sensor, "image"_a = view.image, "corners"_a = view.corners,
                          "board_rms_px"_a = view.board_rms_px, "stripe_points"_a = view.stripe_points,
                          "stripe_rms_px"_a = view.stripe_rms_px, "left_out"_a = view.left_out));
  return views;
}

void add_calibrate(py::module_& module) {
  py::class_<CalibrateResult, std::shared_ptr<CalibrateResult>>(module, "Calibration",
                                                                "What `calibrate` found.")
      .def_property_readonly("usable", &CalibrateResult::usable)
      .def_property_readonly(
          "reason", [](const CalibrateResult& r) { return in_arguments(r.not_usable); },
          "why it is not usable, and what to do")
      .def_property_readonly(
          "rig", [](const CalibrateResult& r) { return r.calibration.rig; }, "the Rig")
      .def_property_readonly("warnings", [](const CalibrateResult& r) { return in_arguments(r.warnings); })
      .def_property_readonly("num_images", [](const CalibrateResult& r) { return r.seen.images; })
      .def_property_readonly("num_boards", [](const CalibrateResult& r) { return r.seen.boards_found; })
      .def_property_readonly("rejected", &rejected_of, "list of dicts: sensor, image, reason")
      .def_property_readonly("views", &views_of, "list of dicts: residuals of each view, px")
      .def("__repr__", [](const CalibrateResult& r) {
        return fmt::format("<lightstripe.Calibration, {}, boards in {} of {}>",
                           r.usable() ? "usable" : "not usable", r.seen.boards_found,
                           counted(r.seen.images, "image"));
      });
  module.def(
      "calibrate", &run_calibrate, "session"_a, "output"_a = py::none(), py::kw_only(),
      "extraction"_a = py::dict(), "calibration"_a = py::dict(), "cameras"_a = py::none(), "threads"_a = 0,
      "The job of `lightstripe calibrate`: a session file to a rig. `output` names the rig file to "
      "write (none: it is only returned), `cameras` a folder for the cameras in other formats. Options "
      "are dicts over those of the file. Look at `.usable` before you use `.rig`.");
}

/// A folder that is deleted with what is in it: the job writes files, also where the user wants none.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "lightstripe-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw Error(name, "cannot be made",
                  "look at the rights and the space of the folder for temporary files");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A reconstruction; its sections only where the user named no file for the cloud.
struct Reconstruction {
  ReconstructResult result;
  fs::path cloud;
  std::vector<Profile> profiles;
};

struct ReconstructChoices {
  std::optional<fs::path> output, rig, profiles;
  py::dict extraction;
  std::optional<std::int64_t> first_frame, end_frame;
  bool strict = false, resume = false;
  int threads = 0;
};

std::shared_ptr<Reconstruction> run_reconstruct(const fs::path& scan, const ReconstructChoices& choices) {
  ReconstructJob job = read_reconstruct_job(scan, choices.rig.value_or(fs::path()));
  apply_options(job.extraction, choices.extraction, "extraction");
  auto made = std::make_shared<Reconstruction>();
  job.cloud = choices.output.value_or(fs::path());
  job.profiles = choices.profiles.value_or(fs::path());
  job.first_frame = choices.first_frame;
  job.end_frame = choices.end_frame;
  job.strict = choices.strict;
  job.resume = choices.resume;
  job.threads = choices.threads;
  std::vector<Profile>& profiles = made->profiles;
  if (!choices.output) job.on_profile = [&profiles](const Profile& p) { profiles.push_back(p); };
  made->cloud = job.cloud;
  made->result = run_interruptibly([&](const std::stop_token& stop) {
    if (choices.output) return reconstruct(job, {}, stop);
    const TemporaryFolder folder;
    ReconstructJob aside = job;
    aside.cloud = folder.path() / "cloud.ply";
    return reconstruct(aside, {}, stop);
  });
  return made;
}

py::object cloud_of(const Reconstruction& made) {
  if (made.cloud.empty() || !made.result.usable()) return py::none();
  return adopted(read_cloud(made.cloud));
}

void add_reconstruct(py::module_& module) {
  py::class_<Reconstruction, std::shared_ptr<Reconstruction>>(module, "Reconstruction",
                                                              "What `reconstruct` made.")
      .def_property_readonly("usable", [](const Reconstruction& r) { return r.result.usable(); })
      .def_property_readonly(
          "reason", [](const Reconstruction& r) { return in_arguments(r.result.not_usable); },
          "why it is not usable")
      .def_property_readonly("num_frames", [](const Reconstruction& r) { return r.result.summary.frames; })
      .def_property_readonly("num_points", [](const Reconstruction& r) { return r.result.summary.points; })
      .def_property_readonly("num_pictures_skipped",
                             [](const Reconstruction& r) { return r.result.summary.pictures_skipped; })
      .def_readonly("profiles", &Reconstruction::profiles, "list of Profile; empty where files were written")
      .def_property_readonly("cloud", &cloud_of,
                             "the written cloud as a record array; None where no file was written")
      .def("__repr__", [](const Reconstruction& r) {
        return fmt::format("<lightstripe.Reconstruction of {}, {}>",
                           counted(r.result.summary.frames, "frame"),
                           counted(r.result.summary.points, "point"));
      });
  module.def(
      "reconstruct",
      [](const fs::path& scan, std::optional<fs::path> output, std::optional<fs::path> rig,
         std::optional<fs::path> profiles, py::dict extraction, std::optional<std::int64_t> first_frame,
         std::optional<std::int64_t> end_frame, bool strict, bool resume, int threads) {
        return run_reconstruct(
            scan, {std::move(output), std::move(rig), std::move(profiles), std::move(extraction), first_frame,
                   end_frame, strict, resume, threads});
      },
      "scan"_a, "output"_a = py::none(), py::kw_only(), "rig"_a = py::none(), "profiles"_a = py::none(),
      "extraction"_a = py::dict(), "first_frame"_a = py::none(), "end_frame"_a = py::none(),
      "strict"_a = false, "resume"_a = false, "threads"_a = 0,
      "The job of `lightstripe reconstruct`: a scan file to a cloud. `output` names the cloud (.ply, .pcd or "
      ".xyz), `profiles` the table of sections. Without `output` nothing is kept on disk and the sections "
      "are in `.profiles`, all of them in memory.");
}

py::object value_or_none(const std::optional<double>& value) {
  return value ? py::object(py::float_(*value)) : py::none();
}

/// A row of measurements.csv; what is not known is None.
py::dict row_of(const MeasuredFrame& frame, const std::string& verdict) {
  py::dict row("frame"_a = frame.frame, "travel"_a = frame.travel, "nominal"_a = frame.nominal);
  const auto add = [&row](const std::vector<NamedEstimate>& estimates) {
    for (const auto& [name, estimate] : estimates) {
      row[py::str(name)] = value_or_none(estimate.value);
      row[py::str(name + "_sigma")] = value_or_none(estimate.sigma);
    }
  };
  add(frame.estimates);
  row["status"] = frame.status;
  add(frame.extras);
  row["verdict"] = verdict;
  return row;
}

py::list rows_of(const MeasureResult& result) {
  py::list rows;
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    rows.append(row_of(result.rows[i], result.verdicts[i]));
  return rows;
}

ObjectKind object_kind(const std::string& name) {
  for (const ObjectKind kind : {ObjectKind::kRail, ObjectKind::kWheel})
    if (kind_name(kind) == name) return kind;
  throw py::value_error("'" + name + "' is no kind: use rail or wheel");
}

std::shared_ptr<MeasureResult> run_measure(const fs::path& profiles, const std::string& kind,
                                           const std::optional<fs::path>& output, const std::string& nominal,
                                           const py::dict& options, const py::dict& limits,
                                           const std::optional<fs::path>& rig, int threads) {
  MeasureJob job;
  job.profiles = profiles;
  job.kind = object_kind(kind);
  job.reference.nominal = nominal;
  job.rig = rig.value_or(fs::path());
  job.table = output.value_or(fs::path());
  job.threads = threads;
  for (const auto& [name, value] : options) {
    const auto group = py::str(name).cast<std::string>();
    const auto given = value.cast<py::dict>();
    if (group == "registration") {
      apply_options(job.options.registration, given, group);
    } else if (group == "rail") {
      apply_options(job.options.rail, given, group);
    } else if (group == "wheel") {
      apply_options(job.options.wheel, given, group);
    } else {
      throw py::value_error("'" + group + "' is no group of options: use registration, rail or wheel");
    }
  }
  apply_options(job.limits, limits, "limits");
  return std::make_shared<MeasureResult>(
      run_interruptibly([&](const std::stop_token& stop) { return measure(job, {}, stop); }));
}

void add_measure(py::module_& module) {
  py::class_<MeasureResult, std::shared_ptr<MeasureResult>>(module, "Measurements", "What `measure` found.")
      .def_property_readonly("usable", &MeasureResult::usable)
      .def_property_readonly("reason", [](const MeasureResult& r) { return in_arguments(r.not_usable); })
      .def_readonly("num_ok", &MeasureResult::num_ok)
      .def_property_readonly("warnings", [](const MeasureResult& r) { return in_arguments(r.warnings); })
      .def_property_readonly("rows", &rows_of,
                             "list of dicts, the rows of measurements.csv; None where a value is not known. "
                             "pandas.DataFrame(m.rows) makes a table of them.")
      .def("__repr__", [](const MeasureResult& r) {
        return fmt::format("<lightstripe.Measurements of {}, {} ok>", counted(r.rows.size(), "section"),
                           r.num_ok);
      });
  module.def(
      "measure", &run_measure, "profiles"_a, "kind"_a, "output"_a = py::none(), py::kw_only(),
      "nominal"_a = "", "options"_a = py::dict(), "limits"_a = py::dict(), "rig"_a = py::none(),
      "threads"_a = 0,
      "The job of `lightstripe measure`: profiles.csv or a railway file, kind \"rail\" or \"wheel\", to "
      "measurements. `output` names the table (none: only returned).");
}

}  // namespace

void add_jobs(py::module_& module) {
  add_calibrate(module);
  add_reconstruct(module);
  add_measure(module);
}

}  // namespace lightstripe::python
