#include <algorithm>
#include <set>

#include "peritherm/base/text.hpp"
#include "peritherm/simulation/document.hpp"
#include "peritherm/simulation/model_case.hpp"
#include "peritherm/simulation/model_question.hpp"
#include "peritherm/simulation/overrides.hpp"
#include "peritherm/simulation/reader.hpp"

namespace peritherm {
namespace {

constexpr std::size_t longest_folder_name = 255;  ///< as file systems have it

bool has_control(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; });
}

/// As it stands in the file.
struct WrittenLoad {
  std::string name;
  std::vector<std::string> set;
  static constexpr auto options() {
    return std::tuple{
        required("name", &WrittenLoad::name, "of its folder, and in loads.csv"),
        optional("set", &WrittenLoad::set, "what differs from the model's case, as in --set: \"KEY=VALUE\"")};
  }
};

struct WrittenLoads {
  int format = 1;
  std::vector<WrittenLoad> loads;
  static constexpr auto options() {
    return std::tuple{
        required("format", &WrittenLoads::format, "",
                 Check{[](double v) { return v == 1.0; }, "must be 1, the only format this version reads"},
                 "version of the file's format"),
        required("load", &WrittenLoads::loads, "one table per load: [[load]]")};
  }
};

struct TemperatureText {
  Profile value;
  static constexpr auto options() {
    return std::tuple{required("value", &TemperatureText::value, "K", any_number, "")};
  }
};
struct FluxText {
  Profile value;
  static constexpr auto options() { return std::tuple{required("value", &FluxText::value, "W/m^2", any_number, "")}; }
};
struct SourceText {
  Profile value;
  static constexpr auto options() { return std::tuple{required("value", &SourceText::value, "W/m^3", any_number, "")}; }
};

/// The profile in a node, in the unit of `Text`; what is wrong with it is added to `issues`.
template <class Text>
Profile read_profile_text(const toml::node& node, std::vector<Issue>& issues) {
  toml::table table;
  node.visit([&table](const auto& content) { table.insert("value", content); });
  const Locations nowhere;
  Reader reader(nowhere);
  Text text;
  reader.read_table(table, "", text);
  issues.insert(issues.end(), reader.issues().begin(), reader.issues().end());
  return text.value;
}

class LoadsReader {
 public:
  LoadsReader(const ModelCase& model_case, const Document& document)
      : model_case_(model_case), document_(document), base_(load_profiles(model_case.problem, model_case.model.loads)) {
    Reader reader(document.locations);
    reader.read_table(document.root, "", written_);
    issues = document.issues;
    issues.insert(issues.end(), reader.issues().begin(), reader.issues().end());
  }

  std::vector<LoadHistory> read() {
    std::vector<LoadHistory> histories;
    std::set<std::string> names;
    if (written_.loads.empty() && issues.empty()) add("load", "is empty", "Give at least one [[load]]");
    for (std::size_t n = 0; n < written_.loads.size(); ++n) {
      const std::string key = "load." + std::to_string(n);
      check_name(key + ".name", written_.loads[n].name, names);
      LoadHistory history{written_.loads[n].name, base_, model_case_.problem.initial.temperature, false};
      for (std::size_t k = 0; k < written_.loads[n].set.size(); ++k) {
        apply(key + ".set." + std::to_string(k), written_.loads[n].set[k], history);
      }
      histories.push_back(std::move(history));
    }
    return histories;
  }

  std::vector<Issue> issues;

 private:
  void add(const std::string& key, std::string problem, std::string hint) {
    issues.push_back({find_location(document_.locations, key), std::move(problem), std::move(hint)});
  }

  void check_name(const std::string& key, const std::string& name, std::set<std::string>& names) {
    if (name.empty()) {
      if (issues.empty()) add(key, "is empty", "Give the load a name");
    } else if (name.find_first_of("/\\") != std::string::npos || name == "." || name == "..") {
      add(key, "'" + name + "' is no plain name of a folder", "Leave out / and \\");
    } else if (has_control(name)) {
      add(key, "has line breaks or other control characters", "Leave them out");
    } else if (name.size() > longest_folder_name) {
      add(key, "has more than " + std::to_string(longest_folder_name) + " bytes, too many for the name of a folder",
          "Choose a shorter name");
    } else if (name == "loads.csv" || name == "summary.json" || name == "resolved.toml") {
      add(key, "'" + name + "' is the name of a file that stands beside the folders of the loads",
          "Choose another name");
    } else if (!names.insert(name).second) {
      add(key, "another load is called '" + name + "' too", "Give each its own name");
    }
  }

  void apply(const std::string& at, const std::string& text, LoadHistory& history) {
    toml::table root;
    std::vector<Issue> found;
    const std::vector<AppliedOverride> applied = apply_overrides(root, {text}, found);
    if (found.empty()) {
      const std::string& key = applied.front().key;
      const toml::node* node = &root;
      for (auto dots = std::count(key.begin(), key.end(), '.') + 1; dots > 0 && node->is_table(); --dots) {
        node = &node->as_table()->begin()->second;
      }
      set(key, *node, history, found);
    }
    for (Issue& issue : found) add(at, std::move(issue.problem), std::move(issue.hint));
  }

  void set(const std::string& key, const toml::node& node, LoadHistory& history, std::vector<Issue>& found) {
    const auto& loads = model_case_.model.loads;
    const auto load = std::find_if(loads.begin(), loads.end(), [&key](const Load& other) { return other.key == key; });
    if (key == "initial.temperature") {
      history.start = read_profile_text<TemperatureText>(node, found);
      history.own_start = true;
      check_profile_text(history.start, true, found);
    } else if (load == loads.end()) {
      found.push_back({{}, key + ": is nothing that the loads of a model can differ in", known_keys()});
    } else {
      Profile& profile = history.loads[static_cast<std::size_t>(load - loads.begin())];
      profile = load->kind == LoadKind::temperature ? read_profile_text<TemperatureText>(node, found)
                : load->source >= 0                 ? read_profile_text<SourceText>(node, found)
                                                    : read_profile_text<FluxText>(node, found);
      check_profile_text(profile, false, found);
    }
  }

  std::string known_keys() const {
    std::vector<std::string> keys{"initial.temperature"};
    for (const Load& load : model_case_.model.loads) keys.push_back(load.key);
    return "Choose among " + join(keys) + "; outputs and the end are set for all loads at once, with --set";
  }

  static void check_profile_text(const Profile& profile, bool start, std::vector<Issue>& found) {
    if (!found.empty() || profile.is_number()) return;
    try {
      if (CompiledProfile(profile).depends_on_time() && start) {
        found.push_back({{}, "the temperature at the start cannot depend on t", "Use x, y and z only"});
      }
    } catch (const Error& error) {
      found.push_back(error.issues().front());
    }
  }

  const ModelCase& model_case_;
  const Document& document_;
  std::vector<Profile> base_;
  WrittenLoads written_;
};

}  // namespace

std::vector<LoadHistory> read_loads(std::string_view toml, const std::string& file, const ModelCase& model_case) {
  const Document document = read_document(toml, file, {}, "Begin with format = 1 and [[load]]");
  LoadsReader reader(model_case, document);
  std::vector<LoadHistory> histories = reader.read();
  sort_by_place(reader.issues);
  if (!reader.issues.empty()) throw Error(std::move(reader.issues));
  return histories;
}

std::vector<LoadHistory> read_loads_file(const std::string& path, const ModelCase& model_case) {
  return read_loads(read_text_file(path), path, model_case);
}

}  // namespace peritherm
