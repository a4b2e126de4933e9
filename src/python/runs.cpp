#include <pybind11/stl.h>

#include <exception>
#include <optional>
#include <string>

#include "perilink.hpp"
#include "python/bindings.hpp"
#include "python/python_caller.hpp"
#include "python/thread_scope.hpp"

namespace perilink {
namespace {

namespace py = pybind11;
py::tuple run(const CaseFile& input, const std::string& directory, int threads,
              OldResults old_results, py::object progress,
              const std::optional<std::string>& calibrations) {
  PythonCaller caller(std::move(progress));
  RunEnd end;
  {
    const py::gil_scoped_release unlocked;
    const ThreadScope scope;
    RunSettings settings{ThreadScope::begin(threads), old_results, true};
    settings.callbacks.stop_requested = [&] { return caller.stop_requested(); };
    settings.callbacks.on_row = [&](const RowProgress& row) { caller.on_row(row); };
    settings.callbacks.on_calibration = [&](int, double) { caller.raise_if_stopped(); };
    std::optional<CalibrationFiles> files;
    if (calibrations) settings.callbacks.calibrations = &files.emplace(*calibrations);
    end = run_case(input, directory, settings);
  }
  caller.raise();
  if (end.error) std::rethrow_exception(end.error);
  if (end.termination == Termination::failed) throw SolverError(end.reason);
  return py::make_tuple(to_string(end.termination), end.reason, end.summary.text);
}

py::dict history(const std::string& path) {
  const CsvTable table = read_csv(path);
  py::dict columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (const std::vector<double>& row : table.rows) values.push_back(row[c]);
    columns[py::str(table.columns[c])] = owning_array(std::move(values));
  }
  return columns;
}

py::dict arrays_of(std::vector<VtuArray>& fields) {
  py::dict arrays;
  for (VtuArray& field : fields) {
    const auto components = static_cast<py::ssize_t>(field.components);
    const auto size = static_cast<py::ssize_t>(field.values.size()) / components;
    ArrayShape shape{size};
    if (components > 1) shape.push_back(components);
    arrays[py::str(field.name)] = owning_array(std::move(field.values), std::move(shape));
  }
  return arrays;
}

py::dict field_file(const std::string& path) {
  VtuGrid grid = read_vtu(path);
  const auto points = static_cast<py::ssize_t>(grid.points.size()) / 3;
  py::dict result, values;
  result["points"] = owning_array(std::move(grid.points), {points, 3});
  result["connectivity"] = owning_array(std::move(grid.connectivity));
  result["offsets"] = owning_array(std::move(grid.offsets));
  result["point_data"] = arrays_of(grid.point_data);
  result["cell_data"] = arrays_of(grid.cell_data);
  for (const auto& [name, value] : grid.field_data) values[py::str(name)] = value;
  result["values"] = values;
  return result;
}

std::vector<std::pair<double, std::string>> field_series(const std::string& path) {
  std::vector<std::pair<double, std::string>> series;
  for (const PvdEntry& entry : read_pvd(path)) series.emplace_back(entry.time, entry.file);
  return series;
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<RowProgress>(module, "Row",
                          "A row of the history, for the progress function of `run`.")
      .def_readonly("row", &RowProgress::row, "Number of rows so far.")
      .def_readonly("step", &RowProgress::step, "Number of the event or time step.")
      .def_readonly("time", &RowProgress::time, "Time of explicit runs [time].")
      .def_readonly("load_factor", &RowProgress::load_factor, "Factor of the loads [-].")
      .def_readonly("load", &RowProgress::load, "Load [force].")
      .def_readonly("displacement", &RowProgress::displacement,
                    "Work-conjugate displacement [length].")
      .def_readonly("broken_bonds", &RowProgress::broken_bonds, "Bonds that are broken.")
      .def("__repr__", [](const RowProgress& row) {
        return fmt::format("Row(row={}, load={:.6g}, displacement={:.6g}, broken_bonds={})",
                           row.row, row.load, row.displacement, row.broken_bonds);
      });
  py::enum_<OldResults>(module, "OldResults")
      .value("refused", OldResults::refused)
      .value("removed", OldResults::removed)
      .value("kept", OldResults::kept);
  module.def("run", run, py::arg("case"), py::arg("directory"), py::arg("threads") = 0,
             py::arg("old_results") = OldResults::refused, py::arg("progress") = py::none(),
             py::arg("calibrations") = py::none());
  module.def("refuse_old_results", [](const std::string& directory, bool force) {
    refuse_old_results(directory, force);
  });
  module.def("require_result", [](const std::string& directory) { require_result(directory); });
  module.def("read_history", history, py::arg("path"));
  module.def("read_fields", field_file, py::arg("path"));
  module.def("read_series", field_series, py::arg("path"));
}

}  // namespace perilink
