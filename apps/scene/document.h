#pragma once

#include <span>
#include <string>
#include <string_view>

#include <toml++/toml.h>

namespace lagomorph::apps {

/// A scene's TOML with the overrides in it, before any of it means anything. Every node knows where it comes
/// from.
class Document {
public:
  /// `origin` is the file's name in messages. Throws Error(wrong_input) with place.
  Document(std::string_view text, std::string origin, std::span<const std::string> overrides);

  const toml::table& root() const { return root_; }
  /// Where a node or key stands, as a message begins: "scenes/a.toml:12:3: " or "--set body.0.density=x: ".
  std::string place(const toml::source_region&) const;

private:
  void apply(const std::string& override_text);

  std::string origin_;
  toml::table root_;
};

}  // namespace lagomorph::apps
