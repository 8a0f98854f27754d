// A study of one cloud.
#pragma once

#include <string>
#include <vector>

#include "src/study/ledger.h"
#include "src/study/progress.h"
#include "src/study/route.h"
#include "src/study/study.h"
#include "src/study/truth.h"

namespace stipple {

// What a study has found so far.
struct Findings {
  std::vector<Curve> curves;
  Json views = Json::array();
  Json paths = Json::array();
  Json summaries = Json::array();
  std::vector<std::string> failures;
};

class InputStudy {
 public:
  // All must outlive it. `dataset` was opened from `input`; `name` is the cloud's in folders and tables.
  InputStudy(const StudySettings& settings, std::string input, std::string name, const Dataset& dataset, Ledger& ledger,
             StudyProgress& progress, Findings& findings);

  // Adds to the findings. Throws Interrupted; what methods throw otherwise becomes a failure.
  void run();

 private:
  View view_of(const Camera& camera) const;
  std::vector<Route> routes() const;
  bool finished(const Route& route) const;
  std::string key(const Route& route, Regime regime, Mode mode, int repeat) const;
  std::string folder(const std::string& kind, const std::string& name) const;
  void study(const Route& route);
  Json describe(const Route& route, TruthMaker& maker, const Truth& last) const;
  std::vector<Truth> truths_of(const Route& route, Json& description) const;
  void study_mode(const Route& route, Regime regime, Mode mode, const std::vector<Truth>& truths);
  Curve curve(const Route& route, Regime regime, Mode mode, int repeat, const std::vector<Truth>& truths);
  Curve draw(const Route& route, Regime regime, Mode mode, int repeat, const std::vector<Truth>& truths);
  std::string provenance(const Route& route, const Curve& curve) const;

  const StudySettings& settings_;
  std::string input_;
  std::string name_;
  const Dataset& dataset_;
  Ledger& ledger_;
  StudyProgress& progress_;
  Findings& findings_;
  std::vector<NamedCamera> cameras_;
  std::vector<CameraPath> paths_;
};

}  // namespace stipple
