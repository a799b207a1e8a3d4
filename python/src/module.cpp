// billet for Python: what billet/run.h offers, as the module billet._native.
//
// Thin on purpose: names, defaults, and what a user reads are in the package's Python files. Here
// arrays are handed over without copies, and calls that take time leave the interpreter to other
// threads. They take turns among each other: MUMPS has one state for all runs.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "billet/run.h"

namespace py = pybind11;

namespace {

using Shape = std::vector<py::ssize_t>;

/// Recursive for the thread in which Python ends, which keeps it.
std::recursive_timed_mutex& turn() {
  static std::recursive_timed_mutex mutex;
  return mutex;
}

/// The thread in which Python ends; none: it does not.
std::atomic<std::thread::id>& ending() {
  static std::atomic<std::thread::id> thread{};
  return thread;
}

/// Waits for this thread's turn; for ever in other threads than that in which Python ends.
void take(std::unique_lock<std::recursive_timed_mutex>& own) {
  const std::thread::id last = ending();
  while (last != std::thread::id{} && last != std::this_thread::get_id())
    std::this_thread::sleep_for(std::chrono::hours(1));
  own.lock();
}

/// Calls a function without the interpreter's lock, and no other one of ours meanwhile.
///
/// The turn is over only when the interpreter's lock is taken again: who has the turn knows that no
/// other thread is about to take that lock, which would end the process once Python has ended.
template <class Function> auto alone(Function&& function) {
  std::unique_lock own(turn(), std::defer_lock);
  const py::gil_scoped_release released;
  take(own);
  return function();
}

/// Has the increments end that other threads solve, and no other begin: Python ends.
/// @throws py::error_already_set  for Ctrl-C
void end_of_python() {
  ending() = std::this_thread::get_id();
  const auto taken = [] {
    const py::gil_scoped_release released;
    return turn().try_lock_for(std::chrono::milliseconds(100));
  };
  while (!taken())
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
}

/// Calls end_of_python when Python ends in this process; a fork of it has none of its threads.
void register_end_of_python() {
  const pid_t process = getpid();
  const py::cpp_function at_end([process] {
    if (getpid() == process)
      end_of_python();
  });
  static_cast<void>(py::module_::import("atexit").attr("register")(at_end));
}

/// A run that is freed in its turn.
class OwnRun {
public:
  /// @param content  a copy, for other threads may change the case meanwhile
  OwnRun(billet::Case content, int threads)
      : run_(alone([&] {
          return std::make_unique<billet::Run>(std::move(content),
                                               billet::RunOptions{{}, threads, false});
        })) {}
  explicit OwnRun(billet::Run run) : run_(std::make_unique<billet::Run>(std::move(run))) {}
  ~OwnRun() {
    alone([&] { run_.reset(); });
  }
  OwnRun(const OwnRun&) = delete;
  OwnRun& operator=(const OwnRun&) = delete;

  /// Calls a function of the run in its turn.
  template <class Function> auto call(Function&& function) const {
    return alone([&] { return function(*run_); });
  }

private:
  std::unique_ptr<billet::Run> run_;
};

const char* name_of(billet::Status status) {
  switch (status) {
  case billet::Status::running:
    return "running";
  case billet::Status::done:
    return "done";
  case billet::Status::not_converged:
    return "not-converged";
  }
  return "";
}

/// An increment, and its row of the table of increments.
using Solved = std::pair<billet::Increment, std::vector<double>>;

std::optional<Solved> last_of(const billet::Run& run) {
  if (run.last_increment().number == 0)
    return std::nullopt;
  const auto row = run.history().last(std::min(run.history().size(), run.history_columns().size()));
  return Solved{run.last_increment(), {row.begin(), row.end()}};
}

/// The status, and the last of the increments that were solved, if any was.
std::pair<const char*, std::optional<Solved>> advance(billet::Run& run) {
  const int before = run.increment();
  const char* const status = name_of(run.advance());
  return {status, run.increment() == before ? std::nullopt : last_of(run)};
}

py::ssize_t rows(std::size_t n_values, int columns) {
  return static_cast<py::ssize_t>(n_values) / std::max(columns, 1);
}

/// An array over memory that an owner holds; the array holds the owner.
template <class T, class Owner> py::array over(const T* data, const Shape& shape, Owner owner) {
  auto held = std::make_unique<Owner>(std::move(owner));
  const py::capsule holder(held.get(), [](void* pointer) { delete static_cast<Owner*>(pointer); });
  static_cast<void>(held.release()); // the capsule's now
  return py::array_t<T>(shape, data, holder);
}

/// An array in which the run's own memory is kept; nobody may write there.
template <class T> py::array read_only(const billet::Kept<T>& kept, int columns) {
  py::array array = over(kept.values.data(), {rows(kept.values.size(), columns), columns},
                         std::shared_ptr<const void>(kept.owner));
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// name, unit, values of shape (n,) or (n, components).
py::tuple as_tuple(billet::NodalField field) {
  Shape shape{rows(field.values.size(), field.components)};
  if (field.components > 1)
    shape.push_back(field.components);
  const double* const data = field.values.data(); // stays where it is in the vector that is moved
  return py::make_tuple(field.name, field.unit, over(data, shape, std::move(field.values)));
}

void bind_case(py::module_& module) {
  using billet::Case;
  py::class_<Case>(module, "Case")
      .def_static("load",
                  [](const std::string& file, const std::vector<std::string>& overrides,
                     bool allow_outside) { return Case::load(file, overrides, allow_outside); })
      .def_static("from_text",
                  [](const std::string& text, const std::string& folder, bool allow_outside) {
                    return Case::from_text(text, folder, allow_outside);
                  })
      .def("set", py::overload_cast<const std::vector<std::string>&>(&Case::set))
      .def("erase", &Case::erase)
      .def("text", &Case::text)
      .def("resolved_text", &Case::resolved_text)
      .def("save", [](const Case& self, const std::string& file) { self.save(file); })
      .def("name", &Case::name)
      .def("folder", [](const Case& self) { return self.folder().string(); })
      .def("copy", [](const Case& self) { return Case(self); })
      .def("check", [](const Case& self) {
        const Case own = self; // which another thread cannot change meanwhile
        const billet::CaseReport report = alone([&] { return own.check(); });
        return py::make_tuple(report.warnings, report.advice);
      });
}

void bind_increment(py::module_& module) {
  using billet::Increment;
  py::class_<Increment>(module, "Increment")
      .def_readonly("number", &Increment::number)
      .def_readonly("time", &Increment::time)
      .def_readonly("length", &Increment::length)
      .def_readonly("iterations", &Increment::iterations)
      .def_readonly("cutbacks", &Increment::cutbacks)
      .def_readonly("residuals", &Increment::residuals)
      .def_readonly("events", &Increment::events);
}

/// How a run goes on, and how it is stored.
void bind_progress(py::class_<OwnRun>& run) {
  using billet::Run;
  run.def(py::init<billet::Case, int>())
      .def("advance", [](OwnRun& self) { return self.call([](Run& r) { return advance(r); }); })
      .def("status",
           [](OwnRun& self) { return name_of(self.call([](Run& r) { return r.status(); })); })
      .def("reason", [](OwnRun& self) { return self.call([](Run& r) { return r.reason(); }); })
      .def("ended_by", [](OwnRun& self) { return self.call([](Run& r) { return r.ended_by(); }); })
      .def("time", [](OwnRun& self) { return self.call([](Run& r) { return r.time(); }); })
      .def("increment",
           [](OwnRun& self) { return self.call([](Run& r) { return r.increment(); }); })
      .def("last", [](OwnRun& self) { return self.call([](Run& r) { return last_of(r); }); })
      .def("failed_checks",
           [](OwnRun& self) { return self.call([](Run& r) { return r.failed_checks(); }); })
      .def("save",
           [](OwnRun& self) { return py::bytes(self.call([](Run& r) { return r.save(); })); })
      .def("load",
           [](OwnRun& self, const py::bytes& saved) {
             const std::string bytes = saved;
             self.call([&](Run& r) { r.load(bytes); });
           })
      .def("copy", [](OwnRun& self) {
        return std::make_unique<OwnRun>(self.call([](Run& r) { return r.copy(); }));
      });
}

/// What there is to see of a run.
void bind_view(py::class_<OwnRun>& run) {
  using billet::Run;
  run.def("history_columns",
          [](OwnRun& self) { return self.call([](Run& r) { return r.history_columns(); }); })
      .def("history",
           [](OwnRun& self) {
             auto [values, columns] = self.call([](Run& r) {
               return std::pair(std::vector<double>(r.history().begin(), r.history().end()),
                                static_cast<int>(r.history_columns().size()));
             });
             const double* const data = values.data();
             const Shape shape{rows(values.size(), columns), columns};
             return over(data, shape, std::move(values));
           })
      .def("units",
           [](OwnRun& self) {
             const billet::Units units = self.call([](Run& r) { return r.units(); });
             return py::dict(py::arg("length") = units.length, py::arg("force") = units.force,
                             py::arg("time") = units.time, py::arg("stress") = units.stress,
                             py::arg("temperature") = units.temperature);
           })
      .def("dimension",
           [](OwnRun& self) { return self.call([](Run& r) { return r.dimension(); }); })
      .def("positions",
           [](OwnRun& self) {
             const auto [kept, columns] =
                 self.call([](Run& r) { return std::pair(r.keep_positions(), r.dimension()); });
             return read_only(kept, columns);
           })
      .def("elements",
           [](OwnRun& self) {
             const auto [kept, columns] = self.call(
                 [](Run& r) { return std::pair(r.keep_elements(), r.nodes_per_element()); });
             return read_only(kept, columns);
           })
      .def("field_names",
           [](OwnRun& self) { return self.call([](Run& r) { return r.field_names(); }); })
      .def("field",
           [](OwnRun& self, const std::string& name) {
             return as_tuple(self.call([&](Run& r) { return r.nodal_field(name); }));
           })
      .def("fields",
           [](OwnRun& self) {
             py::list fields;
             for (billet::NodalField& field : self.call([](Run& r) { return r.nodal_fields(); }))
               fields.append(as_tuple(std::move(field)));
             return fields;
           })
      .def("tools", [](OwnRun& self) { return self.call([](Run& r) { return r.tools(); }); })
      .def("tool_force",
           [](OwnRun& self, std::size_t tool) {
             return self.call([&](Run& r) { return r.tool_force(tool); });
           })
      .def("tool_torque", [](OwnRun& self, std::size_t tool) {
        return self.call([&](Run& r) { return r.tool_torque(tool); });
      });
}

} // namespace

PYBIND11_MODULE(_native, module) {
  module.doc() = "The library billet, as the package billet uses it.";
  module.attr("__version__") = BILLET_VERSION;
  py::register_exception<billet::RunError>(module, "Error");
  bind_case(module);
  bind_increment(module);
  py::class_<OwnRun> run(module, "Run");
  bind_progress(run);
  bind_view(run);
  register_end_of_python();
}
