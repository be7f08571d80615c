"""A model is judged against one that drops its assumptions.

    rule           figures of a model, differences from another, the uncertainty of either
    contact        each model by itself          comparison             two of one problem
    coupling       what friction moves           yielding               what flows
    effects        the half-plane's assumptions, each with what dropping it may change
    model_error    the half-plane against the whole model: finite elements with all that matters
    ladder         every model against the whole model, and what each takes
    verdict        what follows, in words

Each of these is a `Study` of the run, as are the questions of `comparisons.studies`."""
