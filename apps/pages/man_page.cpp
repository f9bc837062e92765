#include "apps/pages/man_page.h"

#include <spdlog/fmt/fmt.h>

#include <string_view>

#include "apps/folprom/program.h"

namespace folprom::pages {
namespace {

// Text that troff prints as it stands.
std::string Escaped(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    // A point at the start of a line would be a request.
    if (c == '.' && (escaped.empty() || escaped.back() == '\n')) escaped += "\\&";
    switch (c) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '"':
        escaped += "\\(dq";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string Bold(std::string_view text) { return fmt::format("\\fB{}\\fR", Escaped(text)); }
std::string Italic(std::string_view text) { return fmt::format("\\fI{}\\fR", Escaped(text)); }

std::string Capitals(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string Head(const std::string& page, const std::string& summary, const ManEdition& edition) {
  return fmt::format(
      ".TH {} 1 \"{}\" \"folprom {}\" \"User Commands\"\n.nh\n.ad l\n.SH NAME\n{} \\- {}\n",
      Escaped(Capitals(page)), edition.date, edition.version, Escaped(page), Escaped(summary));
}

std::string Examples(const Command& command) {
  std::string text = ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : command.examples) text += Escaped(example) + "\n";
  return text + ".fi\n";
}

std::string Description(const Command& command) {
  if (command.paragraphs.empty()) return "";
  std::string text = ".SH DESCRIPTION\n";
  for (const std::string& paragraph : command.paragraphs) {
    if (&paragraph != &command.paragraphs.front()) text += ".PP\n";
    text += Escaped(paragraph) + "\n";
  }
  return text;
}

std::string Entry(const Argument& argument) {
  std::string text = ".TP\n";
  for (const std::string& name : argument.names) {
    if (&name != &argument.names.front()) text += ", ";
    text += Bold(name);
  }
  if (!argument.names.empty() && !argument.value.empty()) text += ' ';
  if (!argument.value.empty()) text += Italic(argument.value);
  if (argument.required) text += " (required)";
  return text + "\n" + Escaped(argument.text) + "\n";
}

std::string Options(const Command& command) {
  std::string text = ".SH OPTIONS\n", for_tests;
  for (const Argument& positional : command.positionals) text += Entry(positional);
  for (const Argument& option : command.options) {
    (option.for_tests ? for_tests : text) += Entry(option);
  }
  return for_tests.empty() ? text : text + ".SS For tests\n" + for_tests;
}

std::string ExitStatus() {
  std::string text = ".SH EXIT STATUS\n";
  for (const cli::ExitCode& exit : cli::ExitCodes()) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", exit.code, Escaped(exit.meaning));
  }
  return text;
}

std::string PageOf(const Command& program, const Command& verb) {
  return program.name + "-" + verb.name;
}

// Other pages, in bold with their section, one a line.
std::string SeeAlso(const std::vector<std::string>& pages) {
  std::string text = ".SH SEE ALSO\n";
  for (const std::string& page : pages) {
    text += fmt::format(".BR {} (1){}\n", Escaped(page), &page == &pages.back() ? "" : ",");
  }
  return text;
}

}  // namespace

std::string ManPage(const Command& program, const ManEdition& edition) {
  std::string text = Head(program.name, program.summary, edition);
  text += fmt::format(".SH SYNOPSIS\n{} {} [{} ...]\n", Bold(program.name), Italic("VERB"),
                      Italic("OPTION"));
  text += Examples(program) + Description(program) + ".SH VERBS\n";
  std::vector<std::string> pages;
  for (const Command& verb : program.verbs) {
    text += fmt::format(".TP\n{}\n{}\n", Bold(verb.name), Escaped(verb.summary));
    pages.push_back(PageOf(program, verb));
  }
  return text + Options(program) + ExitStatus() + SeeAlso(pages);
}

std::string VerbManPage(const Command& program, const Command& verb, const ManEdition& edition) {
  std::string text = Head(PageOf(program, verb), verb.summary, edition);
  text += fmt::format(".SH SYNOPSIS\n{} [{} ...]", Bold(program.name + " " + verb.name),
                      Italic("OPTION"));
  for (const Argument& positional : verb.positionals) {
    const std::string value = Italic(positional.value);
    text += positional.required ? fmt::format(" {}", value) : fmt::format(" [{}]", value);
  }
  text += '\n';
  text += Examples(verb) + Description(verb) + Options(verb) + ExitStatus();
  std::vector<std::string> pages = {program.name};
  for (const Command& other : program.verbs) {
    if (other.name != verb.name) pages.push_back(PageOf(program, other));
  }
  return text + SeeAlso(pages);
}

}  // namespace folprom::pages
