// Texts between Python and the scene, whose bytes need not be UTF-8: names of files are what they are, and a program
// may have put anything into a scene.
#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>

namespace wrlkit::python {

namespace py = pybind11;

/// A value: bytes that are no UTF-8 become what os.fsdecode makes of them, so that bytes_of gives them back.
inline py::str text_value(std::string_view bytes) {
  auto* made = PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "surrogateescape");
  if (!made) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

/// A text for people, which can always be printed: such bytes are shown as \xff.
inline py::str shown_text(std::string_view bytes) {
  auto* made = PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "backslashreplace");
  if (!made) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

/// The bytes of a str. Throws cast_error when it is none, UnicodeEncodeError (a ValueError) when it has half a
/// surrogate pair.
inline std::string bytes_of(const py::handle& text) {
  if (!PyUnicode_Check(text.ptr())) throw py::cast_error();
  const auto made = py::reinterpret_steal<py::bytes>(PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape"));
  if (!made) throw py::error_already_set();
  return made;
}

/// The same for what is told to people: it never fails.
inline std::string shown_bytes(const py::handle& text) {
  return py::reinterpret_steal<py::bytes>(PyUnicode_AsEncodedString(text.ptr(), "utf-8", "backslashreplace"));
}

/// A text of a signature: a str in Python, its bytes here.
struct Text {
  std::string bytes;
};

/// An exception of Python's whose text may name files: py::value_error and the like want UTF-8.
struct Raised : py::builtin_exception {
  Raised(PyObject* type, const std::string& text) : builtin_exception(text), type(type) {}
  void set_error() const override { PyErr_SetObject(type, shown_text(what()).ptr()); }
  PyObject* type;
};
inline Raised value_error(const std::string& text) { return {PyExc_ValueError, text}; }
inline Raised type_error(const std::string& text) { return {PyExc_TypeError, text}; }
inline Raised attribute_error(const std::string& text) { return {PyExc_AttributeError, text}; }

}  // namespace wrlkit::python

namespace pybind11::detail {

template <>
struct type_caster<wrlkit::python::Text> {
  PYBIND11_TYPE_CASTER(wrlkit::python::Text, const_name("str"));

  bool load(handle source, bool) {
    if (!PyUnicode_Check(source.ptr())) return false;
    value.bytes = wrlkit::python::bytes_of(source);
    return true;
  }
  static handle cast(const wrlkit::python::Text& text, return_value_policy, handle) {
    return wrlkit::python::text_value(text.bytes).release();
  }
};

}  // namespace pybind11::detail
