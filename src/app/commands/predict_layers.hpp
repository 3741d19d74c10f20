#pragma once

#include <filesystem>

namespace vibrotrough::app {

/// How a prediction is printed.
enum class PredictionFormat { text, json, csv };

/// Prints what the atlas says of each case of a campaign file, before anything is simulated.
/// @throws core::InputError when the campaign file is wrong
void predict_layers(std::filesystem::path const& campaign_file, PredictionFormat format);

}  // namespace vibrotrough::app
