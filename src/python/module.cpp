#include <pybind11/stl.h>

#include <exception>
#include <string>

#include "perilink.hpp"
#include "python/bindings.hpp"

namespace perilink {
namespace {

namespace py = pybind11;

/// Returns a text of the program, which may quote bytes of a file that are no UTF-8.
py::object python_text(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

/// Sets an exception of perilink/errors.py as the error of Python.
template <class... Arguments>
void set_python_error(const char* kind, const Error& error, Arguments... arguments) {
  const py::object type = py::module_::import("perilink.errors").attr(kind);
  const py::object value = type(python_text(error.what()), arguments...);
  PyErr_SetObject(type.ptr(), value.ptr());
}

void translate(std::exception_ptr pointer) {
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const InputError& error) {
    const SourceLocation& where = error.where();
    set_python_error("InputError", error, python_text(where.file), where.line,
                     python_text(where.key));
  } catch (const FileError& error) {
    set_python_error("FileError", error);
  } catch (const SolverError& error) {
    set_python_error("SolverError", error);
  } catch (const Error& error) {
    set_python_error("Error", error);
  }
}

/// Reads a case from text.
/// \param has_lines  later messages give lines of the text
CaseFile read_text(const std::string& text, const std::string& path, bool has_lines) {
  CaseFile input = parse_case(text, path);
  if (!has_lines) input.source.lines.clear();
  return input;
}

}  // namespace
}  // namespace perilink

PYBIND11_MODULE(_core, module) {
  using namespace perilink;
  module.doc() = "C++ part of the package perilink; use the package instead.";
  py::register_exception_translator(translate);
  module.attr("__version__") = program_version();
  module.def("build_summary", build_summary);

  py::class_<CaseFile>(module, "CaseFile")
      .def_property_readonly("path", [](const CaseFile& input) { return input.source.path; })
      .def_readwrite("trust_geometry", &CaseFile::trust_geometry)
      .def("resolved", write_case);
  module.def("parse_case", read_text, py::arg("text"), py::arg("path"), py::arg("has_lines"));
  module.def("read_case", read_case, py::arg("path"));
  module.def("case_json_schema", case_json_schema);
  module.def("case_reference", case_reference);
  bind_runs(module);
  bind_scans(module);
  bind_problems(module);
  bind_events(module);
  bind_time_runs(module);
}
