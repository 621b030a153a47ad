// SPDX-FileCopyrightText: 2026 The Bladewright authors
// SPDX-License-Identifier: MIT

#include "bw/core/motion/robot_arm.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bw/core/base/units.h"
#include "bw/core/blade/blade.h"
#include "bw/core/files/file_set.h"
#include "bw/core/text/json_reader.h"

namespace bw {

namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMaxLink = 1e4;   ///< mm
constexpr double kMaxTurn = 3600;  ///< degrees
constexpr double kReach = 1e-9;    ///< of a cosine, beyond 1 by rounding

Matrix3d turnX(double a) { return AngleAxisd(a, Vector3d::UnitX()).toRotationMatrix(); }
Matrix3d turnY(double a) { return AngleAxisd(a, Vector3d::UnitY()).toRotationMatrix(); }
Matrix3d turnZ(double a) { return AngleAxisd(a, Vector3d::UnitZ()).toRotationMatrix(); }

/// From the forearm's axes, x forward, to the flange's, z forward.
Matrix3d flangeAxes() { return turnY(0.5 * kPi); }

}  // namespace

Pose RobotArm::flange(std::span<const double> q) const {
  const Matrix3d upper = turnZ(q[0]) * turnY(q[1]), fore = upper * turnY(q[2]),
                 hand = fore * turnX(q[3]) * turnY(q[4]) * turnX(q[5]);
  Pose pose;
  pose.position = turnZ(q[0]) * Vector3d(a1, 0, d1) + upper * Vector3d(0, 0, a2) +
                  fore * Vector3d(d4, 0, a3) + hand * Vector3d(d6, 0, 0);
  pose.rotation = Eigen::Quaterniond(hand * flangeAxes()).normalized();
  return pose;
}

double RobotArm::wristDistance(const Pose& flange) const {
  const Vector3d wrist = flange.position - flange.rotation * Vector3d(0, 0, d6);
  return std::hypot(std::hypot(wrist.x(), wrist.y()) - a1, wrist.z() - d1);
}

std::optional<std::vector<double>> RobotArm::jointsFor(const Pose& flange,
                                                       std::span<const double> near) const {
  const Matrix3d hand = flange.rotation.toRotationMatrix() * flangeAxes().transpose();
  const Vector3d wrist = flange.position - flange.rotation * Vector3d(0, 0, d6);
  const double forearm = std::hypot(d4, a3), bend = std::atan2(d4, a3);
  std::optional<std::vector<double>> best;
  double farthest = 0;
  for (const double front : {1.0, -1.0}) {
    const double q1 = std::atan2(front * wrist.y(), front * wrist.x());
    const double r = front * std::hypot(wrist.x(), wrist.y()) - a1, h = wrist.z() - d1;
    const double cosine = (r * r + h * h - a2 * a2 - forearm * forearm) / (2 * a2 * forearm);
    if (!(std::abs(cosine) <= 1 + kReach)) continue;
    for (const double elbow : {1.0, -1.0}) {
      const double gamma = elbow * std::acos(std::clamp(cosine, -1.0, 1.0));
      const double q2 =
          std::atan2(r, h) - std::atan2(forearm * std::sin(gamma), a2 + forearm * std::cos(gamma));
      const double q3 = gamma - bend;
      const Matrix3d w = (turnZ(q1) * turnY(q2 + q3)).transpose() * hand;
      for (const double flip : {1.0, -1.0}) {
        const double q5 = flip * std::atan2(std::hypot(w(0, 1), w(0, 2)), w(0, 0));
        const double q4 = std::atan2(flip * w(1, 0), -flip * w(2, 0)),
                     q6 = std::atan2(flip * w(0, 1), flip * w(0, 2));
        std::vector<double> joints = {q1, q2, q3, q4, q5, q6};
        double turned = 0;
        bool inside = true;
        for (std::size_t k = 0; k < joints.size(); ++k) {
          // The whole turn that is nearest within the range.
          const double turns = std::round((near[k] - joints[k]) / (2 * kPi));
          const double least = std::ceil((range[k][0] - joints[k]) / (2 * kPi)),
                       most = std::floor((range[k][1] - joints[k]) / (2 * kPi));
          inside = inside && least <= most;
          if (!inside) break;
          joints[k] += 2 * kPi * std::clamp(turns, least, most);
          turned = std::max(turned, std::abs(joints[k] - near[k]));
        }
        if (!inside || (best && turned >= farthest)) continue;
        farthest = turned;
        best = std::move(joints);
      }
    }
  }
  return best;
}

Result<RobotArm> parseRobotArm(std::string_view text, const std::string& name) {
  const std::string what = "robot " + name;
  const Result<nlohmann::json> object = parseJsonText(text, what);
  if (!object) return tl::unexpected<Error>(object.error());
  RobotArm arm;
  arm.title = name;
  ObjectReader reader(*object, what);
  int version = 1;
  if (Result<void> ok = reader.version("version", version, 1, 1); !ok)
    return tl::unexpected<Error>(ok.error());
  reader.text("title", arm.title);
  reader.need("links", what + R"( needs the key links, for instance {"d1": 486.5, "a1": 150, …} (mm))");
  if (const nlohmann::json* value = reader.member("links")) {
    ObjectReader links(*value, what + ".links");
    for (const auto& [key, length] : {std::pair{"d1", &arm.d1},
                                      {"a1", &arm.a1},
                                      {"a2", &arm.a2},
                                      {"a3", &arm.a3},
                                      {"d4", &arm.d4},
                                      {"d6", &arm.d6}}) {
      links.need(key, links.path() + " needs the key " + key + " (mm)");
      const bool arms = length == &arm.a2 || length == &arm.d4;
      links.number(key, *length, arms ? 1 : -kMaxLink, kMaxLink);
    }
    reader.adopt(links.finish());
  }
  const std::string form = what + R"(.axes must be a list of six objects {"from_deg": -180, "to_deg": 180})";
  reader.need("axes", form);
  if (const nlohmann::json* value = reader.member("axes")) {
    if (!value->is_array() || value->size() != arm.range.size()) {
      reader.complain("axes", form);
    } else {
      for (std::size_t k = 0; k < arm.range.size(); ++k) {
        ObjectReader axis((*value)[k], what + ".axes[" + std::to_string(k) + "]");
        double from = 0, to = 0;
        axis.need("from_deg", form);
        axis.need("to_deg", form);
        axis.number("from_deg", from, -kMaxTurn, kMaxTurn);
        axis.number("to_deg", to, from, kMaxTurn);
        arm.range[k] = {fromDegrees(from), fromDegrees(to)};
        reader.adopt(axis.finish());
      }
    }
  }
  if (Result<void> ok = reader.finish(); !ok) return tl::unexpected<Error>(ok.error());
  return arm;
}

Result<std::optional<RobotArm>> findRobotArm(const std::string& word) {
  constexpr std::size_t kLimit = 1 << 16;
  const Result<std::filesystem::path> root = resourceFolder();
  if (!root) return tl::unexpected<Error>(root.error());
  std::error_code error;
  const std::filesystem::path file = *root / "robots" / (word + ".json");
  if (word.find('/') != std::string::npos || !std::filesystem::exists(file, error)) return std::nullopt;
  const Result<std::string> bytes = readFile(file, kLimit);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  const Result<RobotArm> arm = parseRobotArm(*bytes, word);
  if (!arm) return tl::unexpected<Error>(arm.error());
  return *arm;
}

}  // namespace bw
