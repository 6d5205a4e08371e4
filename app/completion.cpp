// SPDX-License-Identifier: GPL-3.0-or-later
/// Completions of shells and the manual page, made from the verbs and options of the command line
/// (interface.cpp) and from the catalogues.
#include <algorithm>
#include <functional>
#include <sstream>

#include <CLI/CLI.hpp>

#include "app/interface.hpp"
#include "app/report.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/atlas/catalogues.hpp"
#include "ui/text/handbook_pages.hpp"

namespace extremal::app {
namespace {

std::vector<std::string> idsIn(const std::string& catalogue, const std::string& prefix = {}) {
    std::vector<std::string> ids;
    for (const std::string& id : idsOf(findCatalogue(catalogue)->items)) ids.push_back(prefix + id);
    return ids;
}

std::vector<std::string> catalogueNames() {
    std::vector<std::string> names;
    for (const Catalogue& each : catalogues()) names.push_back(each.name);
    return names;
}

std::vector<std::string> with(std::vector<std::string> words, const char* further) {
    words.emplace_back(further);
    return words;
}

/// What stands for an argument, or behind an option, where it is one of some words.
std::vector<std::string> wordsOf(const std::string& verb, const std::string& name) {
    if (name == "SCENE") return idsIn("presets", "preset:");
    if (name == "SHELL") return {"bash", "zsh", "fish"};
    if (name == "KIND") return verb == "list" ? catalogueNames() : with(idsIn("studies"), "merge");
    if (name == "PAGE") {
        std::vector<std::string> pages;
        for (const QString& page : handbookPages()) pages.push_back(page.toStdString());
        return pages;
    }
    if (name == "--view") return with(idsIn("views"), "all");
    if (name == "--format") return {"md", "html", "tex"};
    if (name == "--language") return {"cpp", "python"};
    if (name == "--systems") return idsIn("presets");
    if (name == "--metric") return {"error", "energy", "momentum", "norm", "phase"};
    return {};
}

struct Word {
    std::string name, about;
    bool takesValue = false;
    std::vector<std::string> words = {};
    std::string type = {};
};

struct Verb {
    std::string name, about;
    std::vector<Word> arguments, options;
};

Verb verbOf(const CLI::App& app) {
    Verb verb{app.get_parent() ? app.get_name() : "", app.get_description(), {}, {}};
    for (const CLI::Option* option : app.get_options()) {
        Word word{
            "", option->get_description(), option->get_items_expected_max() > 0, {}, option->get_type_name()};
        if (option->get_lnames().empty()) {
            word.name = option->get_name();
            word.words = wordsOf(verb.name, word.name);
            verb.arguments.push_back(word);
            continue;
        }
        for (const std::string& name : option->get_lnames()) {
            word.name = "--" + name;
            word.words = wordsOf(verb.name, word.name);
            verb.options.push_back(word);
        }
    }
    return verb;
}

/// The program itself first.
std::vector<Verb> verbsOf(const CLI::App& app) {
    std::vector<Verb> verbs{verbOf(app)};
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        verbs.push_back(verbOf(*verb));
    return verbs;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text.append(text.empty() ? "" : " ").append(word);
    return text;
}
std::string namesOf(const std::vector<Word>& words) {
    std::vector<std::string> names;
    for (const Word& word : words) names.push_back(word.name);
    return joined(names);
}
std::string verbNames(const std::vector<Verb>& verbs) {
    std::vector<std::string> names;
    for (const Verb& verb : verbs)
        if (!verb.name.empty()) names.push_back(verb.name);
    return joined(names);
}

/// `text` with a backslash before every one of these characters.
std::string guarded(const std::string& text, std::string_view characters) {
    std::string safe;
    for (const char c : text) {
        if (characters.find(c) != std::string_view::npos) safe += '\\';
        safe += c;
    }
    return safe;
}
/// In single quotes of a shell.
std::string quoted(const std::string& text) {
    std::string safe = "'";
    for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return safe + "'";
}

std::string bashText(const std::vector<Verb>& verbs) {
    std::ostringstream out;
    out << "# Completions of extremal for bash, made by `extremal completion bash`.\n"
           "_extremal() {\n"
           "    local line=${COMP_LINE:0:COMP_POINT} words cur prev verb='' place=0 i\n"
           "    read -ra words <<< \"$line\"\n"
           "    [[ $line == *[[:space:]] || -z $line ]] && words+=('')\n"
           "    cur=${words[-1]}; prev=${words[-2]}\n"
           "    for ((i = 1; i < ${#words[@]} - 1; ++i)); do\n"
           "        if [[ -z $verb && ${words[i]} != -* ]]; then verb=${words[i]}\n"
           "        elif [[ ${words[i]} != -* && ! ${words[i-1]} =~ ^--(";
    std::vector<std::string> valued;
    for (const Verb& verb : verbs)
        for (const Word& option : verb.options)
            if (option.takesValue && std::find(valued.begin(), valued.end(), option.name) == valued.end())
                valued.push_back(option.name);
    for (std::size_t i = 0; i < valued.size(); ++i) out << (i > 0 ? "|" : "") << valued[i].substr(2);
    out << ")$ ]]; then ((++place)); fi\n"
           "    done\n"
           "    local names='' files=''\n"
           "    case \"$verb:$prev\" in\n";
    for (const Verb& verb : verbs)
        for (const Word& option : verb.options)
            if (option.takesValue) {
                out << "    " << verb.name << ":" << option.name << ") ";
                if (option.words.empty())
                    out << "files=yes ;;\n";
                else
                    out << "names=" << quoted(joined(option.words)) << " ;;\n";
            }
    out << "    *)\n        case \"$verb:$place\" in\n";
    for (const Verb& verb : verbs) {
        const std::string options = namesOf(verb.options);
        if (verb.name.empty()) {
            out << "        :*) names="
                << quoted(verbNames(verbs) + " " + joined(verb.arguments[0].words) + " " + options)
                << "; files=yes ;;\n";
            continue;
        }
        for (std::size_t i = 0; i < verb.arguments.size(); ++i)
            out << "        " << verb.name << ":" << i
                << ") names=" << quoted(joined(verb.arguments[i].words) + " " + options)
                << (verb.arguments[i].name == "SCENE" ? "; files=yes" : "") << " ;;\n";
        out << "        " << verb.name << ":*) names=" << quoted(options) << " ;;\n";
    }
    out << "        esac ;;\n"
           "    esac\n"
           "    COMPREPLY=($(compgen -W \"$names\" -- \"$cur\"))\n"
           "    [[ -n $files && $cur != -* && $cur != preset:* ]] && COMPREPLY+=($(compgen -f -- \"$cur\"))\n"
           "    # bash splits words at colons: what stands before the last one is on the line already.\n"
           "    if [[ $cur == *:* && $COMP_WORDBREAKS == *:* ]]; then\n"
           "        local before=${cur%\"${cur##*:}\"}\n"
           "        for i in \"${!COMPREPLY[@]}\"; do COMPREPLY[i]=${COMPREPLY[i]#\"$before\"}; done\n"
           "    fi\n"
           "}\n"
           "complete -o filenames -F _extremal extremal\n";
    return out.str();
}

std::string zshText(const std::vector<Verb>& verbs) {
    const auto about = [](const std::string& text) { return guarded(text, "[]:\\"); };
    const auto action = [](const Word& word) {
        if (word.words.empty())
            return std::string(":" + (word.type.empty() ? word.name : word.type) + ":_files");
        std::string words;
        for (const std::string& each : word.words) words += (words.empty() ? "" : " ") + guarded(each, ":");
        return ":" + guarded(word.name, ":") + ":" +
               (word.name == "SCENE"
                    ? "{_alternative \"presets:preset:(" + words + ")\" \"files:file:_files\"}"
                    : "(" + words + ")");
    };
    std::ostringstream out;
    out << "#compdef extremal\n# Completions of extremal for zsh, made by `extremal completion zsh`.\n"
           "_extremal() {\n"
           "    local -a verbs\n    verbs=(\n";
    for (const Verb& verb : verbs)
        if (!verb.name.empty()) out << "        " << quoted(verb.name + ":" + about(verb.about)) << "\n";
    out << "    )\n"
           "    if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then\n"
           "        _describe verb verbs\n"
           "        _arguments "
        << quoted("1:SCENE:" + action(verbs[0].arguments[0]).substr(7))
        << "\n"
           "        return\n"
           "    fi\n"
           "    local verb=$words[2]\n"
           "    case $verb in\n";
    for (std::size_t i = 1; i <= verbs.size(); ++i) {
        const Verb& verb = verbs[i % verbs.size()];  // the program itself is the rest, and comes last
        out << "    " << (verb.name.empty() ? "*" : verb.name) << ")\n";
        if (!verb.name.empty()) out << "        shift words; (( CURRENT-- ))\n";
        out << "        _arguments -s";
        for (const Word& option : verb.options)
            out << " \\\n            "
                << quoted("*" + option.name + "[" + about(option.about) + "]" +
                          (option.takesValue ? action(option) : ""));
        for (std::size_t k = 0; k < verb.arguments.size(); ++k)
            out << " \\\n            " << quoted(std::to_string(k + 1) + action(verb.arguments[k]));
        out << " ;;\n";
    }
    out << "    esac\n}\n_extremal \"$@\"\n";
    return out.str();
}

std::string fishText(const std::vector<Verb>& verbs) {
    std::ostringstream out;
    out << "# Completions of extremal for fish, made by `extremal completion fish`.\n";
    const std::string all = verbNames(verbs);
    for (const Verb& verb : verbs) {
        const std::string when = quoted(verb.name.empty() ? "not __fish_seen_subcommand_from " + all
                                                          : "__fish_seen_subcommand_from " + verb.name);
        if (!verb.name.empty())
            out << "complete -c extremal -n '__fish_use_subcommand' -a " << verb.name << " -d "
                << quoted(verb.about) << "\n";
        for (const Word& argument : verb.arguments) {
            if (argument.words.empty()) continue;
            out << "complete -c extremal -n " << when << (argument.name == "SCENE" ? "" : " -f") << " -a "
                << quoted(joined(argument.words)) << "\n";
        }
        for (const Word& option : verb.options) {
            out << "complete -c extremal -n " << when << " -l " << option.name.substr(2) << " -d "
                << quoted(option.about);
            if (option.takesValue) out << " -r";
            if (!option.words.empty()) out << " -f -a " << quoted(joined(option.words));
            out << "\n";
        }
    }
    return out.str();
}

/// A text for roff: no line begins a request, and hyphens are those that are typed.
std::string roff(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) safe += "\\&";
        safe += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
    }
    return safe;
}

std::string manualText(const std::vector<Verb>& verbs) {
    std::ostringstream out;
    out << ".\\\" Made by `extremal manual`.\n"
        << ".TH EXTREMAL 1 \"\" \"extremal " EXTREMAL_VERSION "\" \"User Commands\"\n"
        << ".SH NAME\nextremal \\- compare variational integrators\n.SH SYNOPSIS\n.B "
           "extremal\n[\\fISCENE\\fR]\n.br\n"
        << ".B extremal\n\\fIVERB\\fR [\\fIARGUMENTS\\fR]\n.SH DESCRIPTION\n"
        << roff(verbs[0].about)
        << "\nWithout a verb the window opens. SCENE is the path of a scene file, preset:NAME, or \\- for "
           "standard input.\n";
    const auto options = [&](const std::vector<Word>& words) {
        for (const Word& word : words) {
            out << ".TP\n.B " << roff(word.name);
            if (word.takesValue && word.name.starts_with("--"))
                out << " \\fI" << roff(word.type.empty() ? "VALUE" : word.type) << "\\fR";
            out << "\n" << roff(word.about.empty() ? "see the handbook" : word.about) << "\n";
        }
    };
    const auto example = [&](const std::string& verb) {
        for (const auto& [of, lines] : examples())
            if (of == verb)
                for (const std::string& line : lines)
                    out << ".PP\n.nf\n.RS\n" << roff(line) << "\n.RE\n.fi\n";
    };
    out << ".SH OPTIONS\n";
    options(verbs[0].options);
    for (std::size_t i = 1; i < verbs.size(); ++i) {
        out << ".SH EXTREMAL " << roff(verbs[i].name) << "\n" << roff(verbs[i].about) << ".\n";
        options(verbs[i].arguments);
        options(verbs[i].options);
        example(verbs[i].name);
    }
    out << ".SH ENVIRONMENT\n"
           ".TP\n.B EXTREMAL_WISDOM\nA file of extremal wisdom: measured plans of Fourier transforms.\n"
           ".TP\n.B EXTREMAL_SURFACE\negl: the stage of snapshots is drawn by EGL in place of OSMesa.\n"
           ".TP\n.B EXTREMAL_STAGE\npicture: the stage of the window is drawn without the graphics card.\n"
           ".SH EXIT STATUS\n0 done; 1 a scheme failed numerically, or a comparison differs; 2 unusable "
           "input or arguments;\n"
           "3 the output could not be written; 130 interrupted.\n.SH EXAMPLES\n";
    example("");
    return out.str();
}

}  // namespace

int completionVerb(const std::string& shell) {
    Arguments unused;
    const std::unique_ptr<CLI::App> interface = makeInterface(unused);
    const std::vector<Verb> verbs = verbsOf(*interface);
    if (shell == "bash") return print(bashText(verbs), done);
    if (shell == "zsh") return print(zshText(verbs), done);
    if (shell == "fish") return print(fishText(verbs), done);
    printProblem("completion", "unknown shell \"" + shell + "\"",
                 suggestName(shell, {"bash", "zsh", "fish"}));
    return unusable;
}

int manualVerb() {
    Arguments unused;
    const std::unique_ptr<CLI::App> interface = makeInterface(unused);
    return print(manualText(verbsOf(*interface)), done);
}

}  // namespace extremal::app
