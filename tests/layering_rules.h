// The arrows between the folders (docs/architecture.md) as functions on (path, text): which layer includes what,
// what kernels may not do, and who may name OpenCV. They read tokens, not C++: enough to find a wrong arrow, not to
// prove that there is none.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace lakshya {

using Findings = std::vector<std::string>;

inline bool starts_with_any(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view p) { return text.starts_with(p); });
}

// ---- reading C++ without compiling it

inline std::size_t end_of_raw_string(std::string_view text, std::size_t quote) {
  const std::size_t open = text.find('(', quote);
  if (open == std::string_view::npos) return text.size();
  const std::string close = std::string(")").append(text.substr(quote + 1, open - quote - 1)).append("\"");
  const std::size_t end = text.find(close, open);
  return end == std::string_view::npos ? text.size() : end + close.size();
}

inline std::size_t end_of_literal(std::string_view text, std::size_t quote) {
  std::size_t i = quote + 1;
  while (i < text.size() && text[i] != text[quote] && text[i] != '\n')
    i += text[i] == '\\' ? 2 : 1;
  return std::min(i + 1, text.size());
}

inline bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// 1'000: a quote between two digits separates them.
inline bool is_digit_separator(std::string_view text, std::size_t i) {
  return text[i] == '\'' && i > 0 && i + 1 < text.size() && is_word(text[i - 1]) && is_word(text[i + 1]);
}

// Where the comment or literal that begins at i ends; i if none begins there.
inline std::size_t end_of_skipped(std::string_view text, std::size_t i) {
  const std::string_view two = text.substr(i, 2);
  if (two == "//") return std::min(text.find('\n', i), text.size());
  if (two == "/*") return std::min(text.find("*/", i + 2), text.size() - 2) + 2;
  if (two == "R\"") return end_of_raw_string(text, i + 1);
  if (text[i] == '"' || (text[i] == '\'' && !is_digit_separator(text, i))) return end_of_literal(text, i);
  return i;
}

enum class Literals { keep, drop };

// A literal is read as a whole even if it is kept: the // of "http://" is no comment. Raw ones are always dropped.
inline std::string without_comments(std::string_view text, Literals literals) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = end_of_skipped(text, i);
    const bool keep = end == i || (literals == Literals::keep && (text[i] == '"' || text[i] == '\''));
    out += keep ? text.substr(i, std::max<std::size_t>(end - i, 1)) : " ";
    i = std::max(end, i + 1);
  }
  return out;
}

struct Include {
  std::string name;
  bool quoted = false;
};

inline std::vector<Include> includes_of(std::string_view text) {
  std::vector<Include> found;
  std::istringstream lines(without_comments(text, Literals::keep));
  for (std::string line; std::getline(lines, line);) {
    std::erase_if(line, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    constexpr std::string_view kDirective = "#include";
    if (!line.starts_with(kDirective) || line.size() < kDirective.size() + 2) continue;
    const bool quoted = line[kDirective.size()] == '"';
    const std::size_t begin = kDirective.size() + 1;
    found.push_back({line.substr(begin, line.find(quoted ? '"' : '>', begin) - begin), quoted});
  }
  return found;
}

// ---- the table

struct Layer {
  std::string_view folder;
  std::vector<std::string_view> project;  // folders of ours that it may include
  std::vector<std::string_view> refused;  // headers from outside that it may not include
  bool only_standard = false;             // from outside only the C++ standard library
};

inline const std::vector<Layer>& layers() {
  static const std::vector<Layer> table = {
      {"kernels/", {"kernels/"}, {}, true},
      {"hal/", {"hal/", "kernels/base/"}, {"opencv2/", "yaml-cpp/", "CLI/", "nlohmann/", "Eigen/"}},
      {"app/nav/", {"app/nav/", "kernels/"}, {}, true},
      {"app/core/", {"app/core/", "app/nav/", "hal/", "kernels/"}, {"opencv2/"}},
      {"app/loop/", {"app/loop/", "app/core/", "app/nav/", "hal/", "kernels/"}, {"opencv2/", "CLI/"}},
      {"app/lakshyad/", {"app/lakshyad/", "app/loop/", "app/core/", "app/nav/", "hal/", "kernels/"}, {"opencv2/"}},
      {"app/tools/", {"app/", "hal/", "kernels/"}, {}},
  };
  return table;
}

inline bool is_standard(std::string_view header) {
  return std::all_of(header.begin(), header.end(),
                     [](char c) { return std::islower(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

inline bool may_include(const Layer& layer, std::string_view path, const Include& include) {
  static const std::vector<std::string_view> ours = {"kernels/", "hal/", "app/", "boards/", "tests/", "perf/"};
  const std::string_view name = include.name;
  if (name.find("..") != std::string_view::npos) return false;
  const bool simd_source = path.ends_with("_simd.cc") || path.ends_with("_simd-inl.h");
  if (name.ends_with("_simd-inl.h") && !simd_source) return false;
  if (starts_with_any(name, ours)) return starts_with_any(name, layer.project);
  if (name.starts_with("hwy/")) return layer.folder == "kernels/" && simd_source;
  if (include.quoted || starts_with_any(name, layer.refused)) return false;
  return !layer.only_standard || is_standard(name);
}

inline Findings check_includes(std::string_view path, std::string_view text) {
  const auto layer =
      std::find_if(layers().begin(), layers().end(), [&](const Layer& l) { return path.starts_with(l.folder); });
  if (layer == layers().end()) return {std::string(path) + " is in no layer"};
  Findings findings;
  for (const Include& include : includes_of(text)) {
    if (!may_include(*layer, path, include)) findings.push_back(std::string(path) + " includes " + include.name);
  }
  return findings;
}

// Kernels neither allocate nor throw nor print nor end the program.
inline Findings check_kernel_words(std::string_view path, std::string_view text) {
  static const std::set<std::string, std::less<>> refused = {
      "new",   "malloc", "calloc", "realloc", "make_unique", "throw",       "printf",   "fprintf",    "puts",
      "abort", "exit",   "assert", "cout",    "cerr",        "std::vector", "iostream", "std::string"};
  const std::string code = without_comments(text, Literals::drop);
  Findings findings;
  for (std::size_t i = 0, end = 0; i < code.size(); i = std::max(end, i + 1)) {
    end = i;
    while (end < code.size() && is_word(code[end]))
      ++end;
    const std::string word = code.substr(i, end - i);
    const bool standard = std::string_view(code).substr(0, i).ends_with("std::");
    if (refused.contains(word) || (standard && refused.contains("std::" + word))) {
      findings.push_back(std::string(path) + " uses " + word);
    }
  }
  return findings;
}

inline Findings check_source(std::string_view path, std::string_view text) {
  Findings findings = check_includes(path, text);
  if (path.starts_with("kernels/")) {
    const Findings words = check_kernel_words(path, text);
    findings.insert(findings.end(), words.begin(), words.end());
  }
  return findings;
}

inline Findings check_board_file(const std::filesystem::path& path) {
  static const std::set<std::string> code = {".c", ".cc", ".cpp", ".h", ".hpp", ".cmake", ".py", ".sh"};
  if (!code.contains(path.extension().string()) && path.filename() != "CMakeLists.txt") return {};
  return {path.string() + " is code; a board is data"};
}

inline bool names_opencv(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return text.find("opencv") != std::string::npos;
}

inline bool cmake_names_opencv(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (names_opencv(line.substr(0, line.find('#')))) return true;
  }
  return false;
}

}  // namespace lakshya
