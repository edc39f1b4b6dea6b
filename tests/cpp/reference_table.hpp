// Reads tests/reference/<name>.csv: comment lines, a header, a row a case.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

class Row {
 public:
  explicit Row(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  [[nodiscard]] const std::string& text(const std::string& column) const { return cells_.at(column); }
  [[nodiscard]] double number(const std::string& column) const { return to_number(text(column)); }
  [[nodiscard]] std::vector<double> list(const std::string& column) const {
    std::vector<double> values;
    std::istringstream cells(text(column));
    for (std::string cell; std::getline(cells, cell, ';');) values.push_back(to_number(cell));
    return values;
  }

 private:
  /// Denormals too, which std::stod refuses.
  static double to_number(const std::string& cell) {
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || *end != '\0') throw std::runtime_error("no number in a reference table: " + cell);
    return value;
  }

  std::map<std::string, std::string> cells_;
};

inline std::vector<Row> reference(const std::string& name) {
  std::ifstream file(std::string(REFERENCE_DIR) + "/" + name + ".csv");
  std::vector<std::string> header;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    if (line.ends_with('\r')) line.pop_back();
    std::vector<std::string> cells;
    std::istringstream parts(line + ",");
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < header.size(); ++i) row[header[i]] = cells.at(i);
    rows.emplace_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error("no rows in reference table " + name);
  return rows;
}

/// |found - expected| <= rtol max(|expected|, scale), with both in the message.
#define CHECK_NEAR(found, expected, rtol, scale)                                             \
  do {                                                                                       \
    const double found_ = (found), expected_ = (expected);                                   \
    INFO(#found " = ", found_, ", expected ", expected_);                                    \
    CHECK(std::fabs(found_ - expected_) <= (rtol)*std::fmax(std::fabs(expected_), (scale))); \
  } while (false)
