"""Hull-form hydrodynamics and optimisation: the libraries of isohull on NumPy arrays.

    isohull.nurbs      surfaces, files, hulls cut at the still water, hydrostatics
    isohull.igabem     the Kelvin Green function, wave resistance, waves
    isohull.galv       latent spaces of shape modifications
    isohull.bayesopt   Bayesian optimisation by ask and tell

SI units; x forward, y to port, z up, z = 0 the still water. Arrays are copied in and out as doubles.
What a library refuses is an isohull.Error with its sentence; what it has no memory for a MemoryError.
"""

from . import bayesopt, galv, igabem, nurbs
from ._library import Error, version

__all__ = ["nurbs", "igabem", "galv", "bayesopt", "Error", "version"]
__version__ = version()
