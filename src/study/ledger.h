// What a study has finished, so that one that was interrupted can go on.
#pragma once

#include <fstream>
#include <map>
#include <string>

#include "src/json/json.h"

namespace stipple {

// A file of lines: first the settings, then what was finished, each written at once and under a key.
class Ledger {
 public:
  // Begins the file anew, or with `resume` goes on with the one that is there, if one is; a last line cut short counts
  // for nothing. Throws Error when the file cannot be written, or was made with other settings: then it says which.
  Ledger(const std::string& path, const Json& settings, bool resume);

  // Null when it is not finished. Valid until the next put().
  const Json* find(const std::string& key) const;
  // Throws Error when it cannot be written, a full disk for example.
  void put(const std::string& key, const Json& value);

 private:
  void read(const Json& settings);

  std::string path_;
  std::map<std::string, Json> finished_;
  std::ofstream file_;
};

}  // namespace stipple
