#pragma once

#include "scenario/reader/file_reader.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vibrotrough::scenario {

/// Makes cases like those of a campaign file, at other values of the keys that it varies.
class CaseMaker {
  public:
    /// Reads the campaign file. @throws core::InputError, core::MissingError as read_campaign
    explicit CaseMaker(std::filesystem::path const& campaign_file);

    /// The case with the values of the file outside its design, and these in place of theirs (SI units).
    /// @throws core::InputError when a value is missing, out of range, or does not go with the others
    Scenario make(std::map<std::string, Content> const& values) const;

    /// Paths of the keys that the file varies: in its sweep, its lists and its domain, in this order.
    std::vector<std::string> const& varied_keys() const { return varied_; }
    /// The domain of the surface to learn; empty without one.
    std::vector<DomainAxis> const& domain() const { return text_.domain; }
    /// The path of a key from its path or from the end of it: throw_number is trough.throw_number where only
    /// one varied key ends so.
    /// @throws core::InputError when no varied key is meant, or several are
    std::string full_key(std::string const& name) const;
    /// A value as the user writes it in a campaign file: "1.9", "6 mm", "rolling".
    /// @throws core::InputError when it has the wrong type, unit or range
    Content read_value(std::string const& key, std::string const& text) const;

  private:
    std::string file_;
    CampaignText text_;
    std::vector<std::string> varied_;
    FileSource source_;
    std::optional<double> modulus_;  ///< of the grains in all of the domain, Pa
};

/// Young's modulus for all cases of the domain of a surface, Pa: that of the corners of the domain
/// (choose_modulus()). None without a domain, and where the file gives the modulus.
std::optional<double> modulus_of_domain(CampaignText const& text, std::string const& file,
                                        FileSource const& source);

}  // namespace vibrotrough::scenario
