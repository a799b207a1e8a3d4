// billet manual: the manual page, from the tables of the help.

#include "app/command_line.h"
#include "geometry/base/error.h"

#include <fmt/format.h>

#include <string>

namespace billet::app {

namespace {

/// Text for troff: no escapes, no requests at the start of a line, hyphens that can be copied.
std::string troff(std::string_view text) {
  std::string result;
  bool is_first = true;
  for (const char c : text) {
    if (is_first && (c == '.' || c == '\''))
      result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    is_first = c == '\n';
  }
  return result;
}

std::string capital(std::string_view text) {
  std::string result(text);
  if (!result.empty())
    result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  return result;
}

std::string option_item(const Option& option) {
  const auto spelled = [&](std::string_view name) {
    return option.value.empty()
               ? fmt::format("\\fB{}\\fR", troff(name))
               : fmt::format("\\fB{}\\fR \\fI{}\\fR", troff(name), troff(option.value));
  };
  return fmt::format(".TP\n{}{}\n{}\n", spelled(option.name),
                     option.also.empty() ? "" : ", " + spelled(option.also), troff(option.help));
}

std::string command_section(const Command& command) {
  std::string text = fmt::format(".SS billet {} {}\n{}.\n", troff(command.name),
                                 troff(command.usage), troff(capital(command.summary)));
  for (const Option& option : options_of(command))
    text += option_item(option);
  return text;
}

constexpr std::string_view files = R"(.SH FILES
.TP
\fIcase.toml\fR
A case; see docs/guide/case\-file.md of the source.
.TP
\fIresults/NAME/\fR
Results: NAME.pvd for ParaView, history.csv, summary.json, run.log.
.SH EXAMPLES
.nf
billet check case.toml
billet run case.toml \-\-set tool.punch.friction.m=0.2 \-o results/m\-0.2
billet render results/m\-0.2 \-\-field plastic_strain
billet diff results/a results/b \-\-rtol 1e\-3
.fi
.SH SEE ALSO
.BR billet\-render (1)
)";

} // namespace

int print_manual(const Arguments& arguments) {
  if (!arguments.rest.empty())
    throw Error(Fault::usage, "", "billet manual takes no name");
  std::string text = fmt::format(".TH BILLET 1 \"\" \"billet {}\" \"User Commands\"\n"
                                 ".SH NAME\nbillet \\- implicit simulation of metal forming\n"
                                 ".SH SYNOPSIS\n",
                                 BILLET_VERSION);
  for (const Command& command : commands())
    text += fmt::format("\\fBbillet {}\\fR {}\n.br\n", troff(command.name), troff(command.usage));
  text += ".SH COMMANDS\n";
  for (const Command& command : commands())
    text += command_section(command);
  text += ".SH EXIT STATUS\n";
  for (const ExitStatus& status : exit_statuses())
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", status.number, troff(status.meaning));
  fmt::print("{}{}", text, files);
  return 0;
}

} // namespace billet::app
