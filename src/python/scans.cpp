#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "perilink.hpp"
#include "python/bindings.hpp"
#include "python/python_caller.hpp"

namespace perilink {
namespace {

namespace py = pybind11;

/// Reads a scan from text.
/// \param case_text  text of the case; none: the file that the scan names
ScanFile parse(const std::string& text, const std::string& path,
               const std::optional<std::string>& case_text) {
  ScanFile scan = parse_scan(text, path);
  scan.case_text = case_text;
  return scan;
}

void check_scan(const std::string& text, const std::string& path,
                const std::optional<std::string>& case_text) {
  ScanFile scan = parse(text, path, case_text);
  read_members(scan, {});
}

/// \param words  command line of the members up to `run`; its first word is the program
void scan(const std::string& text, const std::string& path,
          const std::optional<std::string>& case_text, const std::string& directory, int jobs,
          int threads, OldResults old_results, bool trust_geometry,
          const std::vector<std::string>& words, py::object progress) {
  PythonCaller caller(std::move(progress));
  {
    const py::gil_scoped_release unlocked;
    ScanFile scan = parse(text, path, case_text);
    ScanSettings settings{directory};
    settings.jobs = jobs;
    settings.threads = threads;
    settings.old_results = old_results;
    settings.trust_geometry = trust_geometry;
    settings.program = words.front();
    settings.words = words;
    settings.stop_requested = [&] { return caller.stop_requested(); };
    settings.on_member = [&](const EndedMember& member) {
      caller.call(member.number + 1, member_text(scan.members[member.number].settings),
                  member.result.status, member.result.seconds, member.done, member.count);
    };
    const std::vector<CaseFile> cases = read_members(scan, {});
    run_scan(scan, cases, settings);
  }
  caller.raise();
}

/// Runs the program on the words of a command line. \return the exit status
int program(std::vector<std::string> words) {
  words.insert(words.begin(), "perilink");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return run_program(static_cast<int>(words.size()), pointers.data());
}

}  // namespace

void bind_scans(py::module_& module) {
  module.def("check_scan", check_scan, py::arg("text"), py::arg("path"), py::arg("case_text"));
  module.def("scan", scan, py::arg("text"), py::arg("path"), py::arg("case_text"),
             py::arg("directory"), py::arg("jobs"), py::arg("threads"), py::arg("old_results"),
             py::arg("trust_geometry"), py::arg("words"), py::arg("progress"));
  module.def("program", program, py::arg("words"));
}

}  // namespace perilink
