// SFImage and MFBool as arrays of NumPy. An SFImage is width, height, components and a number for each pixel, the
// bottom row first (ISO/IEC 14772-1, 5.5); here it is bytes of (height, width, components), the top row first, as all
// that reads and writes pictures in Python has them.
#pragma once
#include <pybind11/numpy.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wrlkit::python {

namespace py = pybind11;

/// Read-only; empty when pixels are missing.
py::array picture(std::span<const std::int32_t> image);
/// Of an MFImage, one behind the other.
py::list pictures(std::span<const std::int32_t> images);

/// Of an array of (height, width, components) or (height, width), or of the numbers of the standard in one row. Nothing
/// when it is neither.
std::optional<std::vector<std::int32_t>> integers_of_picture(const py::object& value);
std::optional<std::vector<std::int32_t>> integers_of_pictures(const py::object& value);

/// An MFBool, read-only.
py::array truths(std::span<const std::int32_t> values);

}  // namespace wrlkit::python
