#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "perilink.hpp"

/// \file
/// Parts of the extension module perilink._core, and arrays that share memory with C++.

namespace perilink {

/// A case with its model. Arrays of Python share the memory of the model, which never changes.
struct BuiltCase {
  CaseFile input;
  Model model;
};

/// Marks a run that one thread of Python advances, without the interpreter's lock. Needs the lock
/// at its begin and end.
class Advance {
 public:
  /// \throws std::runtime_error if the run is being advanced
  static void refuse(bool is_advancing) {
    if (is_advancing) throw std::runtime_error("another thread of Python is advancing this run");
  }
  explicit Advance(bool& is_advancing) : is_advancing_(is_advancing) {
    refuse(is_advancing);
    is_advancing_ = true;
  }
  ~Advance() { is_advancing_ = false; }
  Advance(const Advance&) = delete;
  Advance& operator=(const Advance&) = delete;

 private:
  bool& is_advancing_;
};

/// Adds the functions that run cases and read results.
void bind_runs(pybind11::module_& module);
/// Adds the functions that run scans.
void bind_scans(pybind11::module_& module);
/// Adds the class Problem and the elastic solution.
void bind_problems(pybind11::module_& module);

/// Adds the class EventRun. Problem must be bound before.
void bind_events(pybind11::module_& module);
/// Adds the class TimeRun. Problem must be bound before.
void bind_time_runs(pybind11::module_& module);

using ArrayShape = std::vector<pybind11::ssize_t>;

/// Returns a read-only array of numbers that another Python object owns, without a copy.
template <class T>
pybind11::array_t<T> array_view(const std::vector<T>& values, ArrayShape shape,
                                pybind11::handle owner) {
  pybind11::array_t<T> array(std::move(shape), values.data(), owner);
  array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

/// Returns an array that owns the numbers, without a copy.
template <class T>
pybind11::array_t<T> owning_array(std::vector<T> values, ArrayShape shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(kept,
                                [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
  return pybind11::array_t<T>(std::move(shape), kept->data(), owner);
}

template <class T>
pybind11::array_t<T> owning_array(std::vector<T> values) {
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  return owning_array(std::move(values), {size});
}

/// Adds the quantities of a row as properties, named as the columns of history.csv.
template <class Row>
void bind_columns(pybind11::class_<Row>& type) {
  for (const RowColumn<Row>& column : columns_of(Row{})) {
    std::string text = column.meaning;
    if (*column.unit != '\0') text.insert(text.size() - 1, std::string(" [") + column.unit + "]");
    const auto get = [&column](const Row& row) -> pybind11::object {
      if (column.counts) return pybind11::int_(static_cast<long>(column.get(row)));
      return pybind11::float_(column.get(row));
    };
    type.def_property_readonly(column.name, get, text.c_str());
  }
}

/// Returns values of the gauges of a model by their names.
inline pybind11::dict gauge_dict(const Model& model, const std::vector<double>& values) {
  pybind11::dict gauges;
  for (std::size_t k = 0; k < values.size(); ++k) {
    gauges[pybind11::str(model.gauges[k].name)] = values[k];
  }
  return gauges;
}

}  // namespace perilink
