// A folder of results as a run leaves it, without a run: two frames of one element and a die.

#pragma once

#include "io/results/pvd.h"
#include "io/results/vtk_writer.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace billet::test {

inline const std::string made_case = R"(title = "Rings & <b>discs</b>"
units = "mm-N-s-MPa-degC"
analysis = "axisymmetric"

[workpiece]
mesh = { file = "gone.msh" }

[[support]]
where = "x = 0"
fix = ["x"]

[[tool]]
name = "punch"
motion = { velocity = [0, -1] }

[time]
end = 2

[[measure]]
name = "fill"
kind = "filling"
)";

inline const std::string made_history =
    "increment,time,dt,iterations,residual,cutbacks,volume,max_penetration,contact_area,"
    "plastic_work,external_work,friction_work,elastic_energy,max_plastic_strain,min_quality,"
    "remeshings,wall_time,punch.force_x,punch.force_y,punch.force_z,punch.torque_x,punch.torque_y,"
    "punch.torque_z,punch.displacement_x,punch.displacement_y,punch.displacement_z,fill\n"
    "1,0.5,0.5,3,1e-8,0,10,0.001,4,5,6,0.5,0.4,0.1,0.9,0,1,0,20000,0,0,0,0,0,-0.5,0,0.25\n"
    "2,1,0.5,4,1e-7,1,10,0.002,4,9,11,0.9,0.4,0.2,0.8,1,2,0,40000,0,0,0,0,0,-1,0,0.75\n";

inline const std::string made_ledger =
    "remeshing,increment,time,cause,elements_before,elements_after,quality_before,quality_after,"
    "volume_before,volume_after,plastic_work_before,plastic_work_after,force_jump,balanced,"
    "solved_again,seconds\n"
    "1,1,0.5,\"element quality 0.19 < 0.2, say\",100,140,0.19,0.7,10,10.001,5,5.05,0.02,1,3,0.4\n";

inline io::WorkpieceFrame one_element(const std::vector<Vec3>& points,
                                      const std::vector<mechanics::Index>& cells,
                                      double value) {
  io::WorkpieceFrame frame;
  frame.points = points;
  frame.cells = cells;
  frame.point_fields = {{"von_mises", 1, {value, 2.0 * value, 3.0 * value, 0.0}, "MPa"},
                        {"displacement", 3, std::vector<double>(12, 0.1), "mm"}};
  frame.cell_fields = {{"element_quality", 1, {1.0}, "1"}};
  return frame;
}

/// Writes the files; those of the end of the run, `summary.json`, are left to the test.
inline void make_results(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "frames");
  write_text(folder / "case.resolved.toml", made_case);
  write_text(folder / "history.csv", made_history);
  write_text(folder / "iterations.csv", "increment,time,iteration,residual,correction,step,"
                                        "contact_changes\n1,0.5,0,1,1,1,0\n1,0.5,1,1e-8,0,1,0\n");
  write_text(folder / "remesh.csv", made_ledger);
  write_text(folder / "run.log", "billet 0.1.0, 2 thread(s), BLAS kernels X\n"
                                 "warning: dies are <small>\nwhat may help: a [[support]]\n");
  const std::vector<mechanics::Index> cells{0, 1, 2, 3};
  std::vector<io::PvdEntry> entries;
  for (int i = 0; i < 2; ++i) {
    const double height = 2.0 - i;
    const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {3, height, 0}, {0, height, 0}};
    const std::string number = "_000" + std::to_string(i);
    io::WorkpieceFrame workpiece = one_element(points, cells, 10.0 + i);
    workpiece.time = i;
    workpiece.notes = {{"symmetry", "x = 0, y = 1, y = 2"}};
    io::write_vtu(folder / "frames" / ("workpiece" + number + ".vtu"), workpiece);
    entries.push_back({1.0 * i, "workpiece", "frames/workpiece" + number + ".vtu"});
    io::SurfaceFrame tool;
    tool.time = i;
    tool.points = {{0, height, 0}, {5, height, 0}};
    tool.lines = {{0, 1}};
    io::write_vtp(folder / "frames" / ("tool-punch" + number + ".vtp"), tool);
    entries.push_back({1.0 * i, "tool-punch", "frames/tool-punch" + number + ".vtp"});
    io::SurfaceFrame contact;
    contact.points = {{3, height, 0}, {0, height, 0}};
    contact.lines = {{0, 1}};
    contact.cell_fields = {{"gap", 1, {0.01 * i}, "mm"}};
    io::write_vtp(folder / "frames" / ("contact" + number + ".vtp"), contact);
    entries.push_back({1.0 * i, "contact", "frames/contact" + number + ".vtp"});
  }
  io::write_pvd(folder / "rings.pvd", entries);
}

inline const std::string made_summary = R"({"title": "Rings", "status": "done", "exit_status": 0,
  "billet": "0.1.0", "element": "quad4", "elements": 1, "nodes": 4, "unknowns": 8, "time": 1.0,
  "ended_by": "full cavity", "warnings": ["warning: dies are <small>"], "failed_checks": [],
  "laps": [{"at": [1, 2, 0], "since": 0.5, "depth": 0.25, "area": 3, "state": "open"}],
  "tools": {"punch": {"force": [0, 40000, 0], "largest_force": {"value": 40000, "time": 1},
    "torque": [0, 0, 0], "displacement": [0, -1, 0], "turned": 0,
    "wear": {"volume": 0.001, "largest_depth": 0.0002, "strokes": 1000},
    "process_window": {"contact_time": 1, "mean_area": 4, "pressure": {"mean": 811, "lowest": 1,
      "highest": 900, "last_mean": 800}}}},
  "seconds": {"total": 2.0, "elements": 1.5, "rest": 0.5}})";

} // namespace billet::test
