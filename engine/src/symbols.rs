//! Texts are kept once and compared by number.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Symbol(u32);

impl Symbol {
    /// Stands where no text is known.
    pub(crate) const UNKNOWN: Self = Self(u32::MAX);

    pub(crate) const fn id(self) -> u32 {
        self.0
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Symbols {
    // copies share them until one learns a new text
    texts: Arc<Vec<Arc<str>>>,
    ids: Arc<HashMap<Arc<str>, u32>>,
}

/// The texts of one knowledge base, which any number of threads may look up.
#[derive(Debug, Default)]
pub(crate) struct Lexicon(RwLock<Symbols>);

impl Lexicon {
    pub(crate) fn read(&self) -> RwLockReadGuard<'_, Symbols> {
        self.0.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// To learn texts while rules run, which is on one thread.
    pub(crate) fn write(&self) -> RwLockWriteGuard<'_, Symbols> {
        self.0.write().unwrap_or_else(PoisonError::into_inner)
    }

    /// To learn texts where nobody else can look.
    pub(crate) fn get_mut(&mut self) -> &mut Symbols {
        self.0.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clone for Lexicon {
    fn clone(&self) -> Self {
        Self(RwLock::new(self.read().clone()))
    }
}

impl Symbols {
    pub(crate) fn intern(&mut self, text: &str) -> Symbol {
        if let Some(&id) = self.ids.get(text) {
            return Symbol(id);
        }
        let id = u32::try_from(self.texts.len()).unwrap_or(u32::MAX);
        if id == u32::MAX {
            return Symbol::UNKNOWN;
        }
        let text: Arc<str> = text.into();
        Arc::make_mut(&mut self.texts).push(Arc::clone(&text));
        Arc::make_mut(&mut self.ids).insert(text, id);
        Symbol(id)
    }

    pub(crate) fn find(&self, text: &str) -> Option<Symbol> {
        self.ids.get(text).copied().map(Symbol)
    }

    /// The text of a symbol; `None` for the unknown one.
    pub(crate) fn text(&self, symbol: Symbol) -> Option<&Arc<str>> {
        self.texts.get(symbol.0 as usize)
    }
}
