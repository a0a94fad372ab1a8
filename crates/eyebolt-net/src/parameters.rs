//! Numbers that are learned.

use crate::graph::{Graph, ParameterId, Role};
use crate::random::Random;
use crate::{Error, identity};

/// The values of a graph's parameters, in its order.
#[derive(Clone, Debug)]
pub struct Parameters {
    version: u64,
    values: Vec<Vec<f32>>,
}

impl PartialEq for Parameters {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values
    }
}

impl Parameters {
    /// Where training starts: weights normally distributed with variance `2 / fan_in` (He et al.,
    /// *Delving deep into rectifiers*, ICCV 2015), batch norms as identities.
    pub fn initial(graph: &Graph, seed: u64) -> Self {
        let streams = Random::new(seed);
        let values = graph.parameters().iter().enumerate().map(|(place, spec)| match spec.role {
            Role::Weight { fan_in } => {
                let mut random = streams.at(place as u64);
                let deviation = (2.0 / fan_in.max(1) as f64).sqrt();
                (0..spec.len()).map(|_| (deviation * random.normal()) as f32).collect()
            }
            Role::Scale | Role::Variance => vec![1.0; spec.len()],
            Role::Bias | Role::Shift | Role::Mean => vec![0.0; spec.len()],
        });
        Self { version: identity::fresh(), values: values.collect() }
    }

    /// Of values in the graph's order.
    ///
    /// # Errors
    /// If one is missing, too many, of another length, or not finite; or a variance is negative.
    pub fn new(graph: &Graph, values: Vec<Vec<f32>>) -> Result<Self, Error> {
        let specs = graph.parameters();
        if specs.len() != values.len() {
            let problem = format!("{} of {}", values.len(), specs.len());
            return Err(Error::input("parameters", problem));
        }
        for (spec, values) in specs.iter().zip(&values) {
            if spec.len() != values.len() {
                let problem = format!("{} values, not {:?}", values.len(), spec.shape);
                return Err(Error::input(&spec.name, problem));
            }
            if let Some(at) = values.iter().position(|value| !value.is_finite()) {
                return Err(Error::input(&spec.name, format!("value {at} is {}", values[at])));
            }
            if spec.role == Role::Variance && values.iter().any(|&value| value < 0.0) {
                return Err(Error::input(&spec.name, "a negative variance"));
            }
        }
        Ok(Self { version: identity::fresh(), values })
    }

    /// Changes whenever a value may have: of two parameters with the same number the values are the
    /// same, so that an executor need not copy them to its device again.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// One parameter.
    pub fn get(&self, id: ParameterId) -> &[f32] {
        &self.values[id.0]
    }

    /// One parameter, to be changed.
    pub fn get_mut(&mut self, id: ParameterId) -> &mut [f32] {
        self.version = identity::fresh();
        &mut self.values[id.0]
    }

    /// All, in the graph's order.
    pub fn values(&self) -> &[Vec<f32>] {
        &self.values
    }

    /// Moves every value by a share of the way to that of `other`: done after every step, a mean of the last
    /// ones.
    ///
    /// # Panics
    /// If the parameters are another network's.
    pub fn approach(&mut self, other: &Self, share: f32) {
        let lengths = |of: &Self| of.values.iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(lengths(self), lengths(other), "parameters of the same network");
        for (values, others) in self.values_mut().iter_mut().zip(&other.values) {
            let pairs = values.iter_mut().zip(others);
            pairs.for_each(|(value, other)| *value += share * (other - *value));
        }
    }

    /// All, to be changed.
    pub(crate) fn values_mut(&mut self) -> &mut [Vec<f32>] {
        self.version = identity::fresh();
        &mut self.values
    }

    /// Number of values that are trained.
    pub fn trained(&self, graph: &Graph) -> usize {
        let specs = graph.parameters().iter().filter(|spec| spec.role.is_trained());
        specs.map(|spec| spec.len()).sum()
    }
}
