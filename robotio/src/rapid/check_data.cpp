// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT
//
// Rules 1, 3, 8, 10, 12, 13 and 14 as far as they concern one declaration.

#include <cmath>

#include "bw/core/text/number_text.h"
#include "rapid/linked_program.h"

namespace bw::robotio {

namespace {

constexpr double kNormTolerance = 1e-6;    ///< of a printed quaternion, rule 10
constexpr double kMaxCoordinate = 1e5;     ///< mm; beyond it single precision has no hundredth of a mm left
constexpr double kUnusedAxis = 9e9;        ///< RAPID's mark of an axis that is not there
constexpr std::size_t kMaxTargets = 5000;  ///< in one module, rule 3
constexpr std::size_t kMaxString = 80;     ///< characters of a RAPID string

void checkRotation(const DataDeclaration& data, std::size_t at, int rule, const std::string& path,
                   Breaches& breaches) {
  const std::vector<double>& n = data.numbers;
  const double norm = Eigen::Vector4d(n[at], n[at + 1], n[at + 2], n[at + 3]).norm();
  if (!(std::abs(norm - 1) <= kNormTolerance))
    breaches.rule(rule, path, data.line,
                  "a quaternion of " + quoted(data.name) + " has norm " + fixedText(norm, 7) +
                      "; it must be 1 within 1e-6");
}

void checkPosition(const DataDeclaration& data, std::size_t at, int rule, const std::string& path,
                   Breaches& breaches) {
  const std::vector<double>& n = data.numbers;
  for (std::size_t i = at; i < at + 3; ++i) {
    if (std::abs(n[i]) <= kMaxCoordinate) continue;
    breaches.rule(rule, path, data.line,
                  quoted(data.name) + " lies at " + shortText(n[i], 6) +
                      " mm; coordinates beyond 100 m are a wrong unit");
    return;
  }
}

void checkExternalAxes(const DataDeclaration& data, std::size_t at, const std::string& path,
                       Breaches& breaches) {
  for (std::size_t i = at; i < at + 6; ++i) {
    if (data.numbers[i] == kUnusedAxis) continue;
    breaches.rule(10, path, data.line,
                  "an external axis of " + quoted(data.name) + " is " + shortText(data.numbers[i], 6) +
                      "; an axis that is not used is written 9E+09");
    return;
  }
}

/// Which storage a type may have: what one task alone uses must not be shared by its name (rule 8).
void checkStorage(const DataDeclaration& data, const std::string& path, Breaches& breaches) {
  const std::string name = quoted(data.name);
  switch (data.type) {
    case DataType::tasks:
      if (data.storage != Storage::persistent)
        breaches.rule(
            8, path, data.line,
            "the task list " + name + " is shared and must be PERS, not " + storageName(data.storage));
      break;
    case DataType::tooldata:
    case DataType::wobjdata:
      if (data.storage != Storage::taskPersistent)
        breaches.rule(8, path, data.line,
                      std::string("the ") + dataTypeName(data.type) + " " + name +
                          " belongs to one task and must be TASK PERS, not " + storageName(data.storage));
      break;
    case DataType::syncident:
      break;
    default:
      if (data.storage == Storage::persistent)
        breaches.rule(8, path, data.line,
                      std::string("the ") + dataTypeName(data.type) + " " + name +
                          " is PERS, which all tasks share by its name; use CONST or TASK PERS");
  }
}

void checkValue(const DataDeclaration& data, const std::string& path, Breaches& breaches) {
  const std::vector<double>& n = data.numbers;
  const std::string name = quoted(data.name);
  switch (data.type) {
    case DataType::robtarget:
      checkPosition(data, kTargetPosition, 10, path, breaches);
      checkRotation(data, kTargetRotation, 10, path, breaches);
      checkExternalAxes(data, kTargetExternal, path, breaches);
      for (std::size_t i = kTargetConf; i < kTargetConf + 4; ++i)
        if (n[i] != std::floor(n[i]) || std::abs(n[i]) > 12) {
          breaches.rule(10, path, data.line,
                        "the confdata of " + name + " must be whole numbers (quarter turns of the axes)");
          break;
        }
      break;
    case DataType::jointtarget:
      checkExternalAxes(data, kJointExternal, path, breaches);
      break;
    case DataType::tooldata:
      if (n[kToolHeld] == 0)
        breaches.rule(14, path, data.line, "the tool " + name + " must be held by the robot (robhold TRUE)");
      if (!(n[kToolMass] > 0))
        breaches.rule(
            14, path, data.line,
            "the mass of the tool " + name + " is " + shortText(n[kToolMass], 6) + " kg; it must be > 0");
      checkPosition(data, kToolPosition, 14, path, breaches);
      checkRotation(data, kToolRotation, 14, path, breaches);
      checkRotation(data, kToolLoadRotation, 14, path, breaches);
      break;
    case DataType::wobjdata:
      if (n[kObjectHeld] != 0 || n[kObjectFixed] == 0)
        breaches.rule(14, path, data.line,
                      "the work object " + name + " must stand fixed in the world ([FALSE,TRUE,...])");
      checkPosition(data, kObjectPosition, 14, path, breaches);
      checkRotation(data, kObjectRotation, 14, path, breaches);
      checkRotation(data, kObjectInnerRotation, 14, path, breaches);
      break;
    case DataType::speeddata:
      if (!(n[0] > 0) || !(n[1] > 0))
        breaches.rule(12, path, data.line, "the speeds of " + name + " must be > 0 mm/s and > 0 degrees/s");
      break;
    case DataType::zonedata:
      if (n[0] == 0 && !(n[1] > 0))
        breaches.rule(13, path, data.line, "the zone " + name + " must be > 0 mm or a fine point");
      break;
    case DataType::tasks:
    case DataType::syncident:
      break;
  }
  for (const std::string_view text : data.texts)
    if (text.size() > kMaxString)
      breaches.rule(1, path, data.line,
                    "a string of " + name + " has " + std::to_string(text.size()) +
                        " characters; at most 80 are allowed");
}

}  // namespace

void checkDeclarations(const LinkedTask& task, Breaches& breaches) {
  for (const Module& module : task.modules) {
    std::size_t targets = 0;
    for (const DataDeclaration& data : module.data) {
      checkStorage(data, module.path, breaches);
      checkValue(data, module.path, breaches);
      if (data.type == DataType::robtarget) ++targets;
    }
    if (targets > kMaxTargets)
      breaches.rule(3, module.path, module.line,
                    "the module holds " + std::to_string(targets) +
                        " targets; split it into modules of at most " + std::to_string(kMaxTargets),
                    Severity::warning);
  }
}

}  // namespace bw::robotio
