// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include <memory>
#include <string>
#include <utility>

namespace lightstripe::python {
namespace {

/// The fields of a record, found in one object of it.
class RecordLayout {
 public:
  template <class Record>
  explicit RecordLayout(const Record& record)
      : begin_(reinterpret_cast<const char*>(&record)), size_(static_cast<py::ssize_t>(sizeof(Record))) {}

  template <class Field>
  RecordLayout& add(const char* name, const Field& field) {
    names_.append(py::str(name));
    formats_.append(py::dtype::of<Field>());
    offsets_.append(py::int_(reinterpret_cast<const char*>(&field) - begin_));
    return *this;
  }
  py::dtype dtype() const { return {names_, formats_, offsets_, size_}; }

 private:
  const char* begin_;
  py::ssize_t size_;
  py::list names_, formats_, offsets_;
};

py::dtype dtype_of(const StripePoint& p) {
  return RecordLayout(p)
      .add("x", p.x)
      .add("y", p.y)
      .add("normal_x", p.normal_x)
      .add("normal_y", p.normal_y)
      .add("width", p.width)
      .add("strength", p.strength)
      .add("sigma_px", p.sigma_px)
      .add("intensity", p.intensity)
      .add("fade_px", p.fade_px)
      .add("flags", p.flags)
      .dtype();
}

py::dtype dtype_of(const ProfilePoint& p) {
  return RecordLayout(p)
      .add("x", p.position.x())
      .add("y", p.position.y())
      .add("z", p.position.z())
      .add("u", p.u)
      .add("v", p.v)
      .add("sigma", p.sigma_mm)
      .add("intensity", p.intensity)
      .add("sensor", p.sensor)
      .add("line", p.line)
      .dtype();
}

py::dtype dtype_of(const CloudPoint& p) {
  return RecordLayout(p)
      .add("x", p.x)
      .add("y", p.y)
      .add("z", p.z)
      .add("intensity", p.intensity)
      .add("frame", p.frame)
      .add("sensor", p.sensor)
      .add("line", p.line)
      .add("sigma", p.sigma)
      .dtype();
}

template <class Record>
py::array view_of_records(const std::vector<Record>& records, py::handle owner) {
  return py::array(dtype_of(Record{}), {static_cast<py::ssize_t>(records.size())},
                   {static_cast<py::ssize_t>(sizeof(Record))}, records.data(), owner);
}

template <class Record>
std::vector<Record> copy_of_records(const py::array& records) {
  const py::dtype wanted = dtype_of(Record{});
  if (records.ndim() != 1 || !records.dtype().equal(wanted))
    throw py::value_error("expected a one-dimensional array of the dtype " +
                          py::repr(wanted).cast<std::string>());
  std::vector<Record> copy(static_cast<std::size_t>(records.shape(0)));
  for (std::size_t i = 0; i < copy.size(); ++i) copy[i] = *static_cast<const Record*>(records.data(i));
  return copy;
}

}  // namespace

py::array view_of(const std::vector<StripePoint>& points, py::handle owner) {
  return view_of_records(points, owner);
}
py::array view_of(const std::vector<ProfilePoint>& points, py::handle owner) {
  return view_of_records(points, owner);
}
std::vector<StripePoint> stripe_points(const py::array& records) {
  return copy_of_records<StripePoint>(records);
}
std::vector<ProfilePoint> profile_points(const py::array& records) {
  return copy_of_records<ProfilePoint>(records);
}

py::array adopted(Image8 image) {
  auto owned = std::make_unique<Image8>(std::move(image));
  const Image8& kept = *owned;
  const py::capsule owner(owned.release(), [](void* memory) { delete static_cast<Image8*>(memory); });
  return py::array(py::dtype::of<std::uint8_t>(), {py::ssize_t{kept.height}, py::ssize_t{kept.width}}, {},
                   kept.pixels.data(), owner);
}

py::array adopted(std::vector<CloudPoint> points) {
  auto owned = std::make_unique<std::vector<CloudPoint>>(std::move(points));
  const std::vector<CloudPoint>& kept = *owned;
  const py::capsule owner(owned.release(),
                          [](void* memory) { delete static_cast<std::vector<CloudPoint>*>(memory); });
  return view_of_records(kept, owner);
}

template <class T>
ImageView<T> image_view(const py::array& image) {
  constexpr auto kPixel = static_cast<py::ssize_t>(sizeof(T));
  constexpr py::ssize_t kMaxSide = 1 << 20;
  if (image.ndim() != 2 || image.shape(0) > kMaxSide || image.shape(1) > kMaxSide)
    throw py::value_error("expected a grey picture: an array of rows x columns, at most 2^20 each");
  if (image.size() > 0 && (image.strides(1) != kPixel || image.strides(0) % kPixel != 0 ||
                           image.strides(0) < image.shape(1) * kPixel))
    throw py::value_error("the pixels of a row have to lie side by side; use numpy.ascontiguousarray(image)");
  return {static_cast<const T*>(image.data()), static_cast<int>(image.shape(1)),
          static_cast<int>(image.shape(0)), image.strides(0) / kPixel};
}

template ImageView<std::uint8_t> image_view(const py::array&);
template ImageView<std::uint16_t> image_view(const py::array&);

}  // namespace lightstripe::python
