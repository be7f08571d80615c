"""A model is judged against one that drops its assumptions.

    rule           figures of a model, differences from another, and the uncertainty of either
    contact        each model by itself          comparison, layered    models of one problem
    coupling       what friction moves           yielding               what flows
    effects        the assumptions of the half-plane, each with what dropping it may change
    model_error    the half-plane against the whole: finite elements with every effect that matters
    ladder         every model against the whole, and what each takes
    verdict        what follows, in words"""
