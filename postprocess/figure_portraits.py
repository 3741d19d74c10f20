"""Layer and point mass over a cycle: phase portraits and velocity profiles, from what was measured phase by phase."""


def plot_portraits(source, case, result, output):
    return []


def plot_profiles(source, case, result, output):
    return []
