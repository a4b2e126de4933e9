#include "io/mesh/gmsh_mesher.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/files.hpp"
#include "base/memory.hpp"
#include "io/case/case_words.hpp"
#include "io/mesh/gmsh_script.hpp"
#include "io/mesh/mesh_file.hpp"

#ifdef PERILINK_GMSH_LIBRARY
#include <dlfcn.h>
#include <gmshc.h>
#endif

namespace perilink {
#ifndef PERILINK_GMSH_LIBRARY

bool has_gmsh() { return false; }

Mesh mesh_geometry(const std::string& path, int dim, std::optional<double> /*size*/,
                   bool /*trusted*/) {
  throw FileError(fmt::format(
      "{}: is a geometry, and this program was built without gmsh to mesh it\n"
      "  mesh it by hand: gmsh -{} -format msh41 {}; or install libgmsh-dev and build again",
      path, dim, path));
}

Mesh mesh_drawing(const std::string& /*script*/, int /*dim*/, double /*size*/) {
  throw FileError("this program was built without gmsh, which places unstructured particles");
}

#else

namespace {

/// Functions of the library, found when it is loaded.
struct Gmsh {
  decltype(&gmshInitialize) initialize = nullptr;
  decltype(&gmshOpen) open = nullptr;
  decltype(&gmshWrite) write = nullptr;
  decltype(&gmshOptionGetNumber) get_number = nullptr;
  decltype(&gmshOptionSetNumber) set_number = nullptr;
  decltype(&gmshModelGetEntities) entities = nullptr;
  decltype(&gmshModelMeshGetElementTypes) element_types = nullptr;
  decltype(&gmshModelMeshClear) clear = nullptr;
  decltype(&gmshModelMeshGenerate) generate = nullptr;
  decltype(&gmshModelGetBoundingBox) box = nullptr;
  decltype(&gmshLoggerGetLastError) last_error = nullptr;
};

Gmsh load_gmsh() {
  void* library = dlopen(PERILINK_GMSH_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {  // a machine that runs the program without building it
    library = dlopen(
        fmt::format("libgmsh.so.{}.{}", GMSH_API_VERSION_MAJOR, GMSH_API_VERSION_MINOR).c_str(),
        RTLD_NOW | RTLD_LOCAL);
  }
  if (library == nullptr) {
    throw FileError(
        fmt::format("gmsh's library cannot be loaded: {}\n  install it (libgmsh), or mesh the "
                    "geometry by hand and name the .msh file",
                    dlerror()));
  }
  const auto find = [library](auto& function, const char* name) {
    void* address = dlsym(library, name);
    if (address == nullptr) throw FileError(fmt::format("gmsh's library lacks {}", name));
    std::memcpy(&function, &address, sizeof address);
  };
  Gmsh gmsh;
  find(gmsh.initialize, "gmshInitialize");
  find(gmsh.open, "gmshOpen");
  find(gmsh.write, "gmshWrite");
  find(gmsh.get_number, "gmshOptionGetNumber");
  find(gmsh.set_number, "gmshOptionSetNumber");
  find(gmsh.entities, "gmshModelGetEntities");
  find(gmsh.element_types, "gmshModelMeshGetElementTypes");
  find(gmsh.clear, "gmshModelMeshClear");
  find(gmsh.generate, "gmshModelMeshGenerate");
  find(gmsh.box, "gmshModelGetBoundingBox");
  find(gmsh.last_error, "gmshLoggerGetLastError");
  return gmsh;
}

/// gmshInitialize has one argument more since gmsh 4.10.
void initialize(void (*function)(int, char**, int, int*), std::vector<char*>& arguments,
                int& error) {
  function(static_cast<int>(arguments.size()), arguments.data(), 0, &error);
}
[[maybe_unused]] void initialize(void (*function)(int, char**, int, int, int*),
                                 std::vector<char*>& arguments, int& error) {
  function(static_cast<int>(arguments.size()), arguments.data(), 0, 0, &error);
}

/// Calls gmsh. To be used once in a process, because gmsh keeps constants of one script for the
/// next.
class Session {
 public:
  explicit Session(std::optional<double> script_size) {
    std::vector<std::string> words = {"perilink"};
    if (script_size) {
      words.insert(words.end(), {"-setnumber", "h", fmt::format("{}", *script_size)});
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    initialize(gmsh_.initialize, arguments, error_);
    check();
    set("General.Terminal", 0.0);
    set("General.NumThreads", 1.0);
  }

  double get(const char* option) {
    double value = 0.0;
    gmsh_.get_number(option, &value, &error_);
    check();
    return value;
  }
  void set(const char* option, double value) {
    gmsh_.set_number(option, value, &error_);
    check();
  }
  void open(const std::string& path) {
    gmsh_.open(path.c_str(), &error_);
    check();
  }
  void generate(int dim) {
    gmsh_.generate(dim, &error_);
    check();
  }
  /// Whether there are entities of a dimension, and all of them have elements.
  bool is_meshed(int dim) {
    int *pairs = nullptr, *types = nullptr;  // freed when the process ends
    std::size_t count = 0, num_types = 1;
    gmsh_.entities(&pairs, &count, dim, &error_);
    for (std::size_t k = 0; error_ == 0 && num_types > 0 && k < count; k += 2) {
      gmsh_.element_types(&types, &num_types, dim, pairs[k + 1], &error_);
    }
    check();
    return count > 0 && num_types > 0;
  }
  /// Returns the number of cubes or squares of a size in the box around the geometry.
  double squares_in_box(int dim, double size) {
    std::array<double, 3> low{}, high{}, sides{};
    gmsh_.box(-1, -1, &low[0], &low[1], &low[2], &high[0], &high[1], &high[2], &error_);
    check();
    for (int a = 0; a < 3; ++a) sides[a] = std::max(0.0, high[a] - low[a]);
    std::ranges::sort(sides, std::greater());
    double squares = 1.0;
    for (int a = 0; a < dim; ++a) squares *= sides[a] / size;
    return squares;
  }
  /// Returns the number of cells of a mesh with all sizes multiplied by a factor.
  double cells_of_coarse_mesh(int dim, double factor) {
    constexpr const char* option = "Mesh.MeshSizeFactor";
    const double own = get(option);
    set(option, factor * own);
    generate(dim);
    const double cells = dim == 2 ? get("Mesh.NbTriangles") + get("Mesh.NbQuadrangles")
                                  : get("Mesh.NbTetrahedra") + get("Mesh.NbHexahedra");
    gmsh_.clear(nullptr, 0, &error_);
    check();
    set(option, own);
    return cells;
  }
  /// Writes format 4.1, even where the script sets another format.
  void write(const std::string& target) {
    set("Mesh.MshFileVersion", 4.1);
    set("Mesh.Binary", 1.0);
    gmsh_.write(target.c_str(), &error_);
    check();
  }

 private:
  void check() {
    if (error_ == 0) return;
    char* text = nullptr;
    int ignored = 0;
    gmsh_.last_error(&text, &ignored);
    throw Error(text != nullptr && text[0] != '\0' ? text : "gmsh gives no reason");
  }

  Gmsh gmsh_ = load_gmsh();
  int error_ = 0;
};

/// Exit status of the child for a size that memory does not allow.
constexpr int too_small = 2;

/// Refuses a size that would keep gmsh busy for hours and then exceed the memory. Bodies fill a
/// part of their box and their cells may grow, so coarse meshes decide, finer ones for slender
/// bodies.
void refuse_small_size(Session& session, int dim, double size) {
  constexpr double bytes_per_cell = 2000.0;  // of the mesh and a run: bonds of three spacings
  constexpr double cells_per_square = 2.3, cells_per_cube = 9.0;
  constexpr double coarse_squares = 1e4, enough_cells = 1e4;
  const double memory = available_memory(), most = memory / bytes_per_cell;
  const double squares = session.squares_in_box(dim, size);
  if (squares * (dim == 2 ? cells_per_square : cells_per_cube) <= most) return;
  double factor = std::max(1.0, std::pow(squares / coarse_squares, 1.0 / dim)), cells = 0.0;
  for (double count = 0.0; count < enough_cells && factor >= 1.0; factor *= 0.25) {
    count = session.cells_of_coarse_mesh(dim, factor);
    cells = count * std::pow(factor, dim);
    if (cells <= most) return;
  }
  throw CellSizeError(fmt::format(
      "gives about {:.1e} cells, with a run of about {}; {} are free, for {:.1e} cells of {:.2g} "
      "times this size",
      cells, bytes_text(cells * bytes_per_cell), bytes_text(memory), most,
      std::pow(cells / most, 1.0 / dim)));
}

void write_mesh(const std::string& path, int dim, std::optional<double> size,
                const std::string& target) {
  const bool script = is_gmsh_script(path);
  Session session(script ? size : std::nullopt);
  session.open(path);
  if (!script && size) {
    session.set("Mesh.MeshSizeMin", *size);
    session.set("Mesh.MeshSizeMax", *size);
  }
  // A script that meshes by itself may have changed its mesh afterwards, for example by
  // Plugin(Crack).
  if (!session.is_meshed(dim) || (dim == 2 && session.is_meshed(3))) {
    if (size) refuse_small_size(session, dim, *size);
    session.generate(dim);
  }
  session.write(target);
}

/// Result of a child process.
struct Outcome {
  int status = 0;       // from waitpid()
  std::string message;  // its output
};

/// Ends the child with its parent, whose lock of the results it also holds, and at the first
/// Ctrl-C.
void follow_parent(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it has ended before that
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

/// Runs gmsh in its own process: gmsh keeps definitions of earlier scripts, and the program can
/// report its crashes.
Outcome mesh_in_child(const std::string& path, int dim, std::optional<double> size,
                      const std::string& target) {
  int ends[2];
  if (pipe(ends) != 0) throw FileError(fmt::format("{}: {}", path, std::strerror(errno)));
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw FileError(fmt::format("{}: {}", path, std::strerror(errno)));
  if (child == 0) {
    follow_parent(parent);
    close(ends[0]);
    std::string message;
    int status = 1;
    try {
      write_mesh(path, dim, size, target);
    } catch (const CellSizeError& error) {
      message = error.what();
      status = too_small;
    } catch (const std::exception& error) {
      message = error.what();
    }
    const auto written = write(ends[1], message.data(), message.size());
    // The parent's buffers and objects must not be flushed or destroyed twice.
    _exit(message.empty() && written == 0 ? 0 : status);
  }
  close(ends[1]);
  Outcome outcome;
  std::array<char, 4096> block;
  for (ssize_t count = 1; count > 0;) {
    count = read(ends[0], block.data(), block.size());
    if (count > 0) outcome.message.append(block.data(), static_cast<std::size_t>(count));
  }
  close(ends[0]);
  while (waitpid(child, &outcome.status, 0) < 0 && errno == EINTR) {
  }
  return outcome;
}

/// A temporary file that is removed with the object.
class TemporaryFile {
 public:
  /// \param termination  of four characters
  explicit TemporaryFile(const std::string& termination) {
    std::string name =
        (std::filesystem::temp_directory_path() / ("perilink_XXXXXX" + termination)).string();
    const int descriptor = mkstemps(name.data(), 4);
    if (descriptor < 0) {
      throw FileError(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
    }
    close(descriptor);
    path_ = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void check_script(const std::string& path, double size) {
  const std::string text = read_regular_file(path);
  static const std::regex constant(R"(DefineConstant\s*\[(?:[^\]]*[\s,])?h\s*=)");
  if (std::regex_search(text, constant)) return;
  throw InputError(
      {path, 0, ""}, "has no constant `h` for mesh_size to set",
      fmt::format(
          "write DefineConstant[ h = {:g} ]; in it, instead of h = ...; if it has that, and "
          "use h as the size of points, or delete mesh_size",
          size));
}

/// gmsh cannot mesh a geometry.
class MeshingError : public Error {
 public:
  using Error::Error;
};

/// \param name  of the geometry, for messages
/// \throws MeshingError, CellSizeError
Mesh mesh_checked(const std::string& path, int dim, std::optional<double> size,
                  const std::string& name) {
  const TemporaryFile target(".msh");
  const Outcome outcome = mesh_in_child(path, dim, size, target.path());
  if (!WIFEXITED(outcome.status)) throw MeshingError("gmsh crashed on it");
  if (WEXITSTATUS(outcome.status) == too_small) throw CellSizeError(outcome.message);
  if (WEXITSTATUS(outcome.status) != 0) {
    throw MeshingError("gmsh cannot mesh it: " + outcome.message);
  }
  return parse_mesh(read_regular_file(target.path()), name, dim);
}

}  // namespace

bool has_gmsh() { return true; }

Mesh mesh_geometry(const std::string& path, int dim, std::optional<double> size, bool trusted) {
  read_regular_file(path, 0);  // refuses pipes, on which gmsh would block
  if (!trusted) refuse_unsafe_geometry(path);
  if (is_gmsh_script(path) && size) check_script(path, *size);
  try {
    return mesh_checked(path, dim, size, path);
  } catch (const MeshingError& error) {
    throw InputError({path, 0, ""}, error.what(),
                     "open the geometry with gmsh to see what is wrong");
  }
}

Mesh mesh_drawing(const std::string& script, int dim, double size) {
  const TemporaryFile drawing(".geo");
  std::ofstream(drawing.path()) << script;
  return mesh_checked(drawing.path(), dim, size, "the drawing of the body");
}

#endif

}  // namespace perilink
